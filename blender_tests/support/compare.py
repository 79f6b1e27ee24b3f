# SPDX-License-Identifier: GPL-3.0-or-later
"""Comparisons with a statistical threshold.

Each side is rendered K times with different seeds. The scatter of the K block means gives the
standard error of their average; it is pooled over the picture (see `_pooled_variances`), because a
variance from K = 3 or 4 values alone has tails that no fixed number of sigmas holds.
"""
import math
from dataclasses import dataclass, field

CHANNEL_NAMES = "rgba"


@dataclass
class Disagreement:
    """One block mean outside its limit."""
    x: int
    y: int
    channel: str
    tested: float
    reference: float
    limit: float

    def __str__(self):
        return (f"block ({self.x},{self.y}) {self.channel}: {self.tested:.6g} instead of "
                f"{self.reference:.6g} (limit {self.limit:.2g})")


@dataclass
class Comparison:
    """Result of `compare_blocks`; true when nothing disagrees and the test had power."""
    failures: list = field(default_factory=list)
    largest_relative: float = 0.0
    mean_relative: float = 0.0
    mean_excess: float = 0.0    # of mean_relative, what `absolute` does not allow for
    noise: float = 0.0
    weak: str = ""

    def __bool__(self):
        return not self.failures and not self.weak

    def __str__(self):
        head = (f"mean difference {self.mean_relative:+.3%}, largest {self.largest_relative:.3%}, "
                f"noise {self.noise:.3%}")
        lines = [head] + ([self.weak] if self.weak else [])
        lines += [str(f) for f in self.failures[:8]]
        if len(self.failures) > 8:
            lines.append(f"... {len(self.failures) - 8} more")
        return "\n".join(lines)


def sidak_z(count, significance=1e-3):
    """Two-sided normal quantile so that `count` independent tests raise one false alarm in 1000."""
    single = 1.0 - (1.0 - significance) ** (1.0 / max(count, 1))
    low, high = 0.0, 10.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if math.erfc(middle / math.sqrt(2.0)) > single:
            low = middle
        else:
            high = middle
    return high


def _mean_and_variance(values):
    mean = sum(values) / len(values)
    if len(values) < 2:
        return mean, 0.0
    return mean, sum((v - mean) ** 2 for v in values) / (len(values) - 1)


def _pixel_variance(pictures, x0, y0, size, channel):
    """Variance of a block mean from the scatter of its pixels, taken as independent."""
    first = pictures[0]
    width, height = min(size, first.width - x0), min(size, first.height - y0)
    total = 0.0
    for y in range(y0, y0 + height):
        start = 4 * (y * first.width + x0) + channel
        rows = [p.rgba[start:start + 4 * width:4] for p in pictures]
        total += sum(_mean_and_variance(values)[1] for values in zip(*rows))
    return total / (width * height) ** 2


def _pooled_variances(positions, raw, size, pixel_based):
    """Variances of the block means, steadied by the pixels and by the other blocks.

    The scatter of K values is the largest of: the block's own, that of its pixels, the mean over
    the block and its neighbours, and the picture's mean ratio of variance to brightness times the
    block's brightness.
    """
    total = sum(abs(mean) for mean, _ in raw)
    ratio = sum(variance for _, variance in raw) / total if total else 0.0
    own = {position: variance for position, (_, variance) in zip(positions, raw)}
    result = []
    for (x, y), (mean, variance), of_pixels in zip(positions, raw, pixel_based):
        around = [own[x + dx, y + dy] for dx in (-size, 0, size) for dy in (-size, 0, size)
                  if (x + dx, y + dy) in own]
        result.append(max(variance, of_pixels, sum(around) / len(around), ratio * abs(mean)))
    return result


def _statistics(pictures, size):
    """{(x, y, channel): (mean, variance of that mean)} over block means of the K pictures."""
    blocks = [p.block_means(size) for p in pictures]
    positions = [(x, y) for x, y, _ in blocks[0]]
    result = {}
    for channel in range(4):
        raw = [_mean_and_variance([b[i][2][channel] for b in blocks])
               for i in range(len(positions))]
        pixel_based = [_pixel_variance(pictures, x, y, size, channel) for x, y in positions]
        variances = _pooled_variances(positions, raw, size, pixel_based)
        for (x, y), (mean, _), variance in zip(positions, raw, variances):
            result[x, y, channel] = (mean, variance / len(pictures))
    return result


def compare_blocks(tested, reference, size, relative=0.005, absolute=1e-5, max_noise=None):
    """Compare block means of two lists of equally sized pictures (one picture a seed).

    A block fails when |difference| > relative * |reference| + absolute + z * standard error; z is
    at least 3 and raised by Sidak's rule for the number of blocks. When the standard error averaged
    over the picture exceeds `max_noise` (default: `relative`) of the mean the result is false as
    well: such a test would prove nothing.
    """
    ours, theirs = _statistics(tested, size), _statistics(reference, size)
    z = max(3.0, sidak_z(len(ours)))
    result = Comparison()
    sums = {"difference": 0.0, "reference": 0.0, "error": 0.0}
    for (x, y, channel), (mean, variance) in ours.items():
        other_mean, other_variance = theirs[x, y, channel]
        error = math.sqrt(variance + other_variance)
        limit = relative * abs(other_mean) + absolute + z * error
        difference = mean - other_mean
        if not abs(difference) <= limit:
            result.failures.append(
                Disagreement(x, y, CHANNEL_NAMES[channel], mean, other_mean, limit))
        if channel < 3:
            sums["difference"] += difference
            sums["reference"] += abs(other_mean)
            sums["error"] += error
            scale = max(abs(other_mean), 1e-6)
            if abs(difference) > absolute:
                result.largest_relative = max(result.largest_relative, abs(difference) / scale)
    if sums["reference"] > 0.0:
        result.mean_relative = sums["difference"] / sums["reference"]
        allowance = absolute * 3 * len(ours) / 4 / sums["reference"]
        result.mean_excess = max(abs(result.mean_relative) - allowance, 0.0)
        result.noise = sums["error"] / sums["reference"]
    allowed = relative if max_noise is None else max_noise
    if result.noise > max(allowed, 1e-6):
        result.weak = f"too noisy to judge: {result.noise:.2%} > {allowed:.2%}"
    return result


def compare_means(tested, reference, relative=0.003, absolute=1e-5, max_noise=None):
    """`compare_blocks` with the whole picture as one block."""
    size = max(tested[0].width, tested[0].height)
    return compare_blocks(tested, reference, size, relative, absolute, max_noise)


def relative_variance(first, second, drop=0.0):
    """Noise of one picture: mean over pixels and RGB of (a - b)^2 / 2 by the squared mean.

    `first` and `second` are two renders that differ in the seed only. `drop` is the share of the
    largest squares left out, to see what a few fireflies weigh.
    """
    squares, total = [], 0.0
    for channel in range(3):
        a, b = first.rgba[channel::4], second.rgba[channel::4]
        squares += [(x - y) ** 2 / 2.0 for x, y in zip(a, b)]
        total += (sum(a) + sum(b)) / 2.0
    count = len(squares)
    mean = total / count
    if drop:
        squares = sorted(squares)[:count - int(drop * count)]
    return sum(squares) / len(squares) / (mean * mean) if mean else math.nan


def relative_difference(first, second, size=16):
    """Mean |difference| of block means (RGB) relative to the mean of `second`."""
    pairs = list(zip(first.block_means(size), second.block_means(size)))
    difference = sum(abs(a[2][c] - b[2][c]) for a, b in pairs for c in range(3))
    total = sum(abs(b[2][c]) for _, b in pairs for c in range(3))
    return difference / total if total else (0.0 if difference == 0.0 else math.inf)


def max_abs_difference(first, second):
    """Largest |difference| over all pixels and channels; NaN counts as infinite."""
    largest = 0.0
    for a, b in zip(first.rgba, second.rgba):
        difference = abs(a - b)
        if not difference <= largest:
            if math.isnan(difference):
                return math.inf
            largest = difference
    return largest

// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/ies_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr long k_max_angles = 10000;
// Candela to watts over the full sphere, by the luminous efficacy of D65: 4 pi / 177.83 lm/W.
constexpr double k_watts_per_candela = 0.0706650768394;

// The numbers of a text, one after the other; commas count as blanks.
class Numbers {
 public:
  explicit Numbers(const char* text) : next_(text) {}
  bool at_end() const { return !next_ || *next_ == '\0'; }
  double real() {
    return read([](const char* text, char** end) { return std::strtod(text, end); });
  }
  long integer() {
    return read([](const char* text, char** end) { return std::strtol(text, end, 10); });
  }
  void skip(long count) {
    for (long i = 0; i < count && !at_end(); ++i)
      real();
  }

 private:
  template <class Read>
  auto read(const Read& convert) -> decltype(convert(nullptr, nullptr)) {
    if (at_end()) return {};
    char* end = nullptr;
    const auto value = convert(next_, &end);
    const bool is_number = end != next_;
    next_ = is_number ? end : nullptr;
    return is_number ? value : decltype(value){};
  }
  const char* next_;
};

float catmull_rom(float a, float b, float c, float d, float t) {
  return b +
         0.5f * t *
             ((c - a) + t * ((2.0f * a - 5.0f * b + 4.0f * c - d) + t * (d + 3.0f * (b - c) - a)));
}

// Index of the interval of `angles` that `x` lies in.
size_t interval(const std::vector<float>& angles, float x) {
  size_t i = 0;
  while (i + 2 < angles.size() && angles[i + 1] < x)
    ++i;
  return i;
}

float share(const std::vector<float>& angles, size_t i, float x) {
  return (x - angles[i]) / (angles[i + 1] - angles[i]);
}

// 0 to 90 degrees off the middle to 0 to 180; what is already -90 to 90 only moves.
bool spread_half_turn(std::vector<float>& angles) {
  if (angles.back() != 90.0f) return false;
  std::vector<float> full;
  if (angles.front() == 0.0f)
    for (size_t i = angles.size() - 1; i > 0; --i)
      full.push_back(90.0f - angles[i]);
  for (const float angle : angles)
    full.push_back(angle + 90.0f);
  angles = std::move(full);
  return true;
}

}  // namespace

IesProfile::IesProfile(const std::string& text) {
  if (parse(text)) {
    for (auto* angles : {&horizontal_, &vertical_})
      for (float& angle : *angles)
        angle *= k_pi / 180.0f;
    return;
  }
  intensity_.clear();
}

bool IesProfile::parse(const std::string& text) {
  std::string plain = text;
  std::replace(plain.begin(), plain.end(), ',', ' ');
  const char* tilt = std::strstr(plain.c_str(), "\nTILT=");
  if (!tilt) return false;
  const bool includes_tilt = std::strncmp(tilt, "\nTILT=INCLUDE", 13) == 0;
  Numbers numbers(includes_tilt ? tilt + 13 : std::strchr(tilt + 1, '\n'));
  if (includes_tilt) {
    numbers.real();  // how the lamp stands in the luminaire
    numbers.skip(2 * std::clamp(numbers.integer(), 0l, k_max_angles));
  }
  numbers.skip(2);  // lamps, lumens of each
  double factor = numbers.real() * k_watts_per_candela;
  const long vertical_count = numbers.integer(), horizontal_count = numbers.integer();
  const long type = numbers.integer();
  numbers.skip(4);  // unit, width, length, height
  factor *= numbers.real();
  factor *= numbers.real();
  numbers.real();  // watts of the luminaire
  const auto is_count = [](long n) { return n > 0 && n <= k_max_angles; };
  if (!is_count(vertical_count) || !is_count(horizontal_count)) return false;
  for (long i = 0; i < vertical_count; ++i)
    vertical_.push_back(static_cast<float>(numbers.real()));
  for (long i = 0; i < horizontal_count; ++i)
    horizontal_.push_back(static_cast<float>(numbers.real()));
  intensity_.resize(horizontal_.size());
  for (auto& row : intensity_)
    for (long i = 0; i < vertical_count; ++i)
      row.push_back(static_cast<float>(numbers.real() * factor));
  if (numbers.at_end()) return false;  // cut off
  constexpr long k_type_c = 1, k_type_b = 2;
  return type == k_type_b ? complete_type_b() : type == k_type_c && complete_type_c();
}

// The axes change places, and each may hold one half of a symmetrical luminaire.
bool IesProfile::complete_type_b() {
  std::vector<std::vector<float>> turned(vertical_.size());
  for (size_t v = 0; v < vertical_.size(); ++v)
    for (const auto& row : intensity_)
      turned[v].push_back(row[v]);
  intensity_ = std::move(turned);
  std::swap(horizontal_, vertical_);
  const size_t rows = intensity_.size();
  if (!spread_half_turn(horizontal_)) return false;
  if (horizontal_.size() > rows) {
    std::vector<std::vector<float>> mirrored(intensity_.rbegin(), intensity_.rend() - 1);
    intensity_.insert(intensity_.begin(), mirrored.begin(), mirrored.end());
  }
  // The cubic needs the full circle.
  horizontal_.push_back(360.0f);
  intensity_.push_back(intensity_.front());
  const size_t columns = intensity_.front().size();
  if (!spread_half_turn(vertical_)) return false;
  if (vertical_.size() > columns) {
    // As in Blender: the mirrored half lies one angle off.
    for (auto& row : intensity_) {
      const std::vector<float> mirrored(row.rbegin() + 1, row.rend());
      row.insert(row.begin(), mirrored.begin(), mirrored.end());
    }
  }
  return true;
}

// A quarter or a half of the circle is mirrored to the whole.
bool IesProfile::complete_type_c() {
  if (horizontal_.front() == 90.0f)
    for (float& angle : horizontal_)
      angle -= 90.0f;
  if (horizontal_.front() != 0.0f) return false;
  if (horizontal_.size() == 1) {
    horizontal_.push_back(360.0f);
    intensity_.push_back(intensity_.front());
  }
  for (const float end : {90.0f, 180.0f}) {
    if (horizontal_.back() != end) continue;
    for (size_t i = horizontal_.size() - 1; i-- > 0;) {
      horizontal_.push_back(2.0f * end - horizontal_[i]);
      intensity_.push_back(std::vector<float>(intensity_[i]));
    }
  }
  if (horizontal_.back() != 360.0f) {
    // The last angle is often left out, as it would repeat the first.
    const size_t n = horizontal_.size();
    const float gap = 360.0f - horizontal_.back();
    const float last_step = horizontal_[n - 1] - horizontal_[n - 2];
    if (gap != last_step && gap != horizontal_[1] - horizontal_[0]) return false;
    horizontal_.push_back(360.0f);
    intensity_.push_back(std::vector<float>(intensity_.front()));
  }
  // One that shines upward only stays dark, as in Blender: its angles are turned, not their order.
  const bool shines_up = vertical_.front() == 90.0f && vertical_.back() == 180.0f;
  if (shines_up)
    for (float& angle : vertical_)
      angle = 180.0f - angle;
  return shines_up || vertical_.front() == 0.0f;
}

float IesProfile::at_vertical(size_t h, size_t v, float t) const {
  const auto& row = intensity_[h];
  // Beyond the pole the luminaire is taken as symmetrical.
  return catmull_rom(row[v == 0 ? 1 : v - 1], row[v], row[v + 1],
                     row[std::min(v + 2, row.size() - 1)], t);
}

float IesProfile::intensity(Vec3 direction) const {
  if (!is_usable()) return k_unusable;
  const Vec3 d = normalize_or(direction, {0.0f, 0.0f, -1.0f});
  const float v_angle = safe_acos(-d.z), h_angle = std::atan2(d.x, d.y) + k_pi;
  if (!(v_angle < vertical_.back())) return 0.0f;
  const size_t v = interval(vertical_, v_angle), h = interval(horizontal_, h_angle);
  const float tv = share(vertical_, v, v_angle);
  const size_t n = horizontal_.size();
  const float value = catmull_rom(
      at_vertical(h == 0 ? n - 2 : h - 1, v, tv), at_vertical(h, v, tv), at_vertical(h + 1, v, tv),
      at_vertical(h + 2 == n ? 1 : h + 2, v, tv), share(horizontal_, h, h_angle));
  return std::isfinite(value) ? std::max(value, 0.0f) : 0.0f;
}

}  // namespace tenniel

# SPDX-License-Identifier: GPL-3.0-or-later
"""The parity page: what every shader node was tried with and how far it is from Cycles.

Needs no Blender: it reads what parity_log.py has written.
"""
import json
import pathlib

# What is in the ids of the tests that compare nodes.
CASES = ("parity", "info_nodes", "test_sky", "tracing_nodes", "closures", "multi_ggx",
         "test_volume", "displacement", "test_lights", "test_aov", "subsurface", "hair",
         "mixed_materials")

# Nodes that Cycles 3.4 does not render either.
_NOT_OF_CYCLES = {
    "ShaderNodeEeveeSpecular": "EEVEE only",
    "ShaderNodeShaderToRGB": "EEVEE only",
    "ShaderNodeOutputLineStyle": "Freestyle only",
    "ShaderNodeUVAlongStroke": "Freestyle only",
    "ShaderNodeSqueeze": "Cycles drops its link",
}

_EVERYWHERE = "part of every comparison"

# What the figures alone do not tell.
_NOTES = {
    "ShaderNodeScript": "not supported: reported by name, neutral. Debian's Cycles has no OSL to "
                        "compare with",
    "ShaderNodeOutputMaterial": _EVERYWHERE,
    "ShaderNodeOutputWorld": _EVERYWHERE,
    "ShaderNodeOutputLight": "with the node trees of lamps",
    "ShaderNodeBsdfGlossy": "Multiscatter GGX: see below. Ashikhmin-Shirley at a slant: below",
    "ShaderNodeBsdfAnisotropic": "Multiscatter GGX: see below",
    "ShaderNodeBsdfGlass": "Multiscatter GGX: see below",
    "ShaderNodeBsdfPrincipled": "Multiscatter GGX: see below",
    "ShaderNodeBsdfRefraction": "compared where a facet can refract the light: see below",
    "ShaderNodeBsdfToon": "compared under lamps: see below",
    "ShaderNodeBsdfHair": "compared under lamps: see below",
}

_EXPLANATIONS = """\
## Where Cycles 3.4 contradicts itself

A closure can be evaluated (for light that is sampled) and sampled (for light that is met). In these
places Cycles' two answers differ from each other. Three of them are how artists know a material, and
Tenniel has both answers (clearcoat, bent normals, bumped velvet). Else Tenniel's agree with each
other, in closed form or by its own tests, so that its pictures do not depend on which lights are
sampled; they can equal one of Cycles' answers only.

* **Multiscatter GGX under lamps.** Cycles' evaluation lets light on its way up meet the surface at
  its very top and squares the tint of later bounces; its samples do neither, and neither does
  Tenniel. A uniform world agrees to 0.3 %. Under lamps Tenniel is brighter, for a white Glossy by at
  most 0.2 % at roughness 0.4, 0.5 % at 0.6, 6 % at 0.8, 21 % at 1; tinted (0.9, 0.5, 0.2) by up to
  2 %, 5 %, 17 % and 43 % in a channel. From version 4.0 on Blender's multiscatter keeps all of the
  light too.
* **Beckmann.** Cycles samples slopes from a table, which brightens what it finds by sampling alone
  by up to 0.7 %. The values agree.
* **Clearcoat.** Cycles draws GGX facets and divides by the density of GTR1's: lamps glow wide in the
  coat, what paths meet by chance is mirrored sharply. Tenniel does the same, for the look's sake.
* **Ashikhmin-Shirley** at a slant on rough surfaces: Cycles turns half vectors below the horizon the
  wrong way and finds too much by sampling. Under lamps both agree.
* **Glossy under a bent normal**: samples of Cycles' lobe may leave below the horizon of that normal,
  where its closure is black, and so may Tenniel's.
* **Velvet under a bump**: the bump shades Cycles' samples as diffuse, its values not, as they count as
  glossy; and Tenniel's likewise.
* **Toon and Hair**: samples of Cycles' closures miss their own density (rim and tangent), so they are
  compared under sharp suns.
* **Refraction** of lamps beyond the critical angle, or with an IOR below 1 near the horizon: Cycles
  adds light off facets that are seen from behind.

## What depends on the picture's resolution

Bump and displacement as bump differentiate over the width of a pixel, in both engines alike.
"""


def write(folder, target):
    """Merge the logs in `folder` into the page `target` (Markdown)."""
    nodes, entries = {}, {}
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        log = json.loads(path.read_text(encoding="utf-8"))
        nodes.update(log["nodes"])
        for idname, entry in log["entries"].items():
            entries[idname] = _merged(entries[idname], entry) if idname in entries else entry
    rows = [_row(idname, facts, entries.get(idname)) for idname, facts in sorted(
        nodes.items(), key=lambda item: item[1]["label"])]
    compared = sum(idname in entries for idname in nodes if idname not in _NOT_OF_CYCLES)
    pathlib.Path(target).write_text(_HEAD.format(
        compared=compared, total=len(nodes) - len(_NOT_OF_CYCLES.keys() & nodes.keys()))
        + "\n".join(rows) + "\n\n" + _EXPLANATIONS, encoding="utf-8")


_HEAD = """\
# Every shader node beside Cycles

Made by `./tenniel test parity`; do not edit. Both engines of the same Blender render the same trees.
{compared} of {total} nodes are compared.

*Values*: the node drawn as emission, each setting with several inputs, as constants and through
links; the worst difference of any, relative to the value where that is above 1. *Pictures*: surfaces
and volumes under worlds and lamps; the worst difference of the means of two pictures (beyond what a
test allows for values near black), and its statistical error. A comparison counts for every node in it, so the figures of a node may be those of
its neighbours. *Settings*: how many items of each were tried.

| node | settings tried | values | worst | pictures | worst | remark |
|---|---|---|---|---|---|---|
"""


def _merged(a, b):
    settings = {name: sorted(set(a["settings"].get(name, ())) | set(b["settings"].get(name, ())))
                for name in a["settings"].keys() | b["settings"].keys()}
    result = {"settings": settings}
    for kind in ("value", "picture"):
        worst = max(a[kind], b[kind], key=lambda part: part["worst"])
        result[kind] = {**worst, "count": a[kind]["count"] + b[kind]["count"],
                        "failed": a[kind]["failed"] + b[kind]["failed"]}
    return result


def _row(idname, facts, entry):
    if idname in _NOT_OF_CYCLES:
        cells = ["", "", "", "", "", f"not rendered by Cycles: {_NOT_OF_CYCLES[idname]}"]
    elif entry is None:
        cells = ["", "", "", "", "", _NOTES.get(idname, "not compared")]
    else:
        remark = _NOTES.get(idname, "")
        failed = entry["value"]["failed"] + entry["picture"]["failed"]
        if failed:
            remark = f"**{failed} outside their limit** {remark}".strip()
        cells = [_settings(facts, entry), *_part(entry["value"], "{:.1e}"),
                 *_part(entry["picture"], "{:.2%}"), remark]
    return f"| {facts['label']} | " + " | ".join(cells) + " |"


def _settings(facts, entry):
    parts = []
    for name, total in sorted(facts["items"].items()):
        tried = len(entry["settings"].get(name, ()))
        parts.append(f"{name} {'all ' if tried >= total else ''}{tried}"
                     + ("" if tried >= total else f" of {total}"))
    return ", ".join(parts)


def _part(part, form):
    if not part["count"]:
        return "", ""
    noise = f" ± {part['noise']:.2%}" if part.get("noise") else ""
    return str(part["count"]), form.format(part["worst"]) + noise

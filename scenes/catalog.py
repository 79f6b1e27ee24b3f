# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes and what each shows. `python3 scenes/catalog.py` prints the list."""

SCENES = {
    "looking_glass": "a still life before a mirror that shows another world (the main scene)",
    "looking_glass_evening": "the same table by candlelight",
    "looking_glass_awake": "the same table, and a mirror like any other: what is really there",
    "bench_room": "closed diffuse room, nine monkeys, 567 k triangles, one area lamp; for timing",
    "material_grid": "one sphere for each closure and texture, lit by an HDRI",
    "materials": "ten materials of many nodes: wood, brick, marble, rust, car paint, fabric, leather, ...",
    "procedural_spheres": "every procedural texture through a ramp and a bump; for timing",
    "textured_spheres": "balls and planks with colour, roughness and normals from pictures",
    "veach_mis": "four glossy plates under four lights: light and BSDF sampling must share",
    "cloud": "a volume object of 6 million voxels that geometry nodes make, in the sun",
    "cornell": "the Cornell box: colour bleeding and soft shadows from an emissive mesh",
}

if __name__ == "__main__":
    for name, summary in SCENES.items():
        print(f"{name:<22} {summary}")

# SPDX-License-Identifier: GPL-3.0-or-later
"""The same cases as Mitsuba scenes, rendered with its reference variant."""

import mitsuba
import numpy

import cases

mitsuba.set_variant("scalar_rgb")

ScalarTransform = mitsuba.ScalarTransform4f


def _rgb(values):
    return {"type": "rgb", "value": list(values)}


def _unbounded(values):
    """A colour beyond 1, such as an index: a picture of one texel is not clipped."""
    texel = numpy.array([[values]], dtype=numpy.float32)
    return {"type": "bitmap", "bitmap": mitsuba.Bitmap(texel), "raw": True,
            "filter_type": "nearest"}


def _surface(wanted):
    alpha = wanted.roughness ** 2
    if wanted.kind == "none":
        return {"type": "null"}
    if wanted.kind == "matte":
        return {"type": "diffuse", "reflectance": _rgb(wanted.color)}
    rough = {"alpha": alpha,
             "distribution": "beckmann" if wanted.distribution == "BECKMANN" else "ggx"}
    if wanted.kind == "glass":
        glass = {"int_ior": wanted.ior, "ext_ior": 1.0}
        return ({"type": "roughdielectric", **glass, **rough} if alpha
                else {"type": "dielectric", **glass})
    index = {"eta": _unbounded(wanted.eta), "k": _unbounded(wanted.k)}
    return ({"type": "roughconductor", **index, **rough} if alpha
            else {"type": "conductor", **index})


def _medium(wanted, anisotropy):
    extinct = [s + a for s, a in zip(wanted.scattering, wanted.absorption)]
    albedo = [s / t for s, t in zip(wanted.scattering, extinct)]
    # A colour is at most 1.
    scale = max(extinct)
    return {"type": "homogeneous", "sigma_t": _rgb(t / scale for t in extinct), "scale": scale,
            "albedo": _rgb(albedo), "phase": {"type": "hg", "g": anisotropy}}


def _ball():
    vertices, triangles = cases.ball()
    mesh = mitsuba.Mesh("ball", len(vertices), len(triangles), has_vertex_normals=True)
    values = mitsuba.traverse(mesh)
    points = numpy.array(vertices, dtype=numpy.float32)
    values["vertex_positions"] = points.ravel()
    values["vertex_normals"] = (points / cases.RADIUS).ravel()
    values["faces"] = numpy.array(triangles, dtype=numpy.uint32).ravel()
    values.update()
    return mesh


def write_ball(path):
    _ball().write_ply(str(path))


def write_environment(path):
    """In Blender's layout: the middle of the picture is +X, the left quarter +Y, the top +Z."""
    width, height = cases.ENVIRONMENT_SIZE
    picture = numpy.empty((height, width, 3), dtype=numpy.float32)
    for row in range(height):
        theta = numpy.pi * (row + 0.5) / height
        for column in range(width):
            phi = 2.0 * numpy.pi * (0.5 - (column + 0.5) / width)
            picture[row, column] = cases.environment(
                numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi),
                numpy.cos(theta))
    mitsuba.Bitmap(picture).write(str(path))


def _scene(case, folder, anisotropy):
    # Mitsuba's environment has Y up and its left edge at -Z; its axes x, y, z become Y, Z, X.
    upright = ScalarTransform([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    ball = {"type": "ply", "filename": str(folder / "ball.ply"),
            "to_world": ScalarTransform().translate(cases.TARGET), "bsdf": _surface(case.surface)}
    if case.medium is not None:
        ball["interior"] = _medium(case.medium, anisotropy)
    return mitsuba.load_dict({
        "type": "scene",
        # Counts edges of a path, the one to the light included.
        "integrator": {"type": "volpathmis" if case.medium is not None else "path",
                       "max_depth": cases.MAX_BOUNCES + 1, "rr_depth": 1000},
        "sensor": {
            "type": "perspective", "fov": float(numpy.degrees(cases.FIELD_OF_VIEW)),
            "fov_axis": "x",
            "to_world": ScalarTransform().look_at(origin=cases.CAMERA, target=cases.TARGET,
                                                  up=(0.0, 0.0, 1.0)),
            "film": {"type": "hdrfilm", "width": cases.WIDTH, "height": cases.HEIGHT,
                     "pixel_format": "rgb", "component_format": "float32",
                     "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"}},
        "light": {"type": "envmap", "filename": str(folder / "environment.exr"),
                  "to_world": upright},
        "floor": {"type": "rectangle",
                  "to_world": ScalarTransform().translate((0.0, 0.0, cases.FLOOR_HEIGHT)).scale(
                      (cases.FLOOR_HALF_WIDTH, cases.FLOOR_HALF_WIDTH, 1.0)),
                  "bsdf": {"type": "twosided",
                           "inner": {"type": "diffuse",
                                     "reflectance": _rgb(cases.FLOOR_COLOR)}}},
        "ball": ball,
    })


def render(case, folder, seed, samples):
    """The picture as an array, top row first. A phase function has one mean cosine here: where it
    differs by channel each channel is rendered on its own."""
    cosines = case.medium.anisotropy if case.medium is not None else (0.0,)

    def picture(cosine):
        return numpy.array(mitsuba.render(_scene(case, folder, cosine), spp=samples, seed=seed))

    if len(set(cosines)) == 1:
        return picture(cosines[0])
    return numpy.stack([picture(cosine)[..., channel] for channel, cosine in enumerate(cosines)],
                       axis=-1)

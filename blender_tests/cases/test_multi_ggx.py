# SPDX-License-Identifier: GPL-3.0-or-later
"""Multiple scattering between GGX facets, against Cycles' walk.

Where it evaluates the closure, Cycles 3.4 lets light on its way up meet the surface at its very top.
That loses a sixth of the light of the roughest surface (bsdf/multi_ggx_test.cpp shows ours loses
none), so the shape is compared where second bounces are few. White, as Cycles 3.4 squares the tint of later bounces where it evaluates the closure, and not where
it samples it.
"""
from cases.test_closures import ClosureCase as _ClosureCase, closure

DISTRIBUTION = {"distribution": "MULTI_GGX"}


class MultiGgxTest(_ClosureCase):

    def test_glossy(self):
        for roughness in (0.4, 0.8, 1.0):
            make = closure("ShaderNodeBsdfGlossy", DISTRIBUTION, Color=(1, 1, 1),
                           Roughness=roughness)
            self.under_world(f"glossy {roughness}", make)
            if roughness < 0.5:
                self.under_lamp(f"glossy {roughness}", make, relative=0.005)

    def test_anisotropic(self):
        make = closure("ShaderNodeBsdfAnisotropic", DISTRIBUTION, Color=(1, 1, 1), Roughness=0.7,
                       Anisotropy=0.5)
        self.under_world("anisotropic", make)

    def test_principled_metal(self):
        make = closure("ShaderNodeBsdfPrincipled", DISTRIBUTION, Base_Color=(1, 1, 1),
                       Metallic=1.0, Roughness=0.7)
        self.under_world("metal", make)

    def test_glass_keeps_the_light(self):
        for roughness, ior in ((0.3, 1.5), (0.8, 1.3)):
            make = closure("ShaderNodeBsdfGlass", DISTRIBUTION, Color=(1, 1, 1),
                           Roughness=roughness, IOR=ior)
            self.under_world(f"glass {roughness}", make, relative=0.02, seeds=3)

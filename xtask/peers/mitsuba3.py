#!/usr/bin/env python3
"""Render the scene of scenes/benchmark with Mitsuba 3 and report its own error; used by `cargo xtask compare mitsuba`.

Needs `pip install mitsuba numpy` and an LLVM library. The scene is built from docs/scenes.md and the numbers of
scenes/benchmark/scene.ron. MERL files go through a BSDF in Python: nearest cell, cosine sampling, as there is no plugin
for them. Prints one JSON object: for two numbers of samples, the seconds of one image and its mean squared error, from
pairs of independent images: mean (A - B)^2 / 2; and writes the mean of all images. With --once it renders and writes one
image, as a user would, and prints nothing.
"""
import argparse
import json
import time

import numpy as np


def bsdf(mi, material):
    if material == "ggx":
        return {"type": "roughconductor", "material": "Cu", "distribution": "ggx", "alpha": 0.1}
    if material.endswith(".bsdf"):
        return {"type": "measured", "filename": material}
    return {"type": "merl", "filename": material}


def scene(mi, a):
    to = mi.ScalarTransform4f
    grey = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.5}}
    parts = {
        "type": "scene",
        # max_depth counts edges of a path: 5 scattering vertices
        "integrator": {"type": "path", "max_depth": 6, "rr_depth": 1000},
        "sensor": {
            "type": "perspective", "fov_axis": "y", "fov": 35,
            "to_world": to().look_at(origin=[0, 2.2, 6.5], target=[0, 1, 0], up=[0, 1, 0]),
            "sampler": {"type": "independent"},
            "film": {"type": "hdrfilm", "width": a.width, "height": a.height, "rfilter": {"type": "box"},
                     "pixel_format": "rgb"},
        },
        "sphere": {"type": "sphere", "center": [0, 1, 0], "radius": 1, "bsdf": bsdf(mi, a.material)},
        "ground": {"type": "rectangle", "to_world": to().rotate([1, 0, 0], -90) @ to().scale([10, 10, 1]), "bsdf": grey},
        "lamp": {"type": "rectangle", "to_world": to().translate([0, 4, 1]) @ to().rotate([1, 0, 0], 90), "bsdf": grey,
                 "emitter": {"type": "area", "radiance": {"type": "rgb", "value": 10}}},
    }
    if a.light == "env":
        parts["sky"] = {"type": "constant", "radiance": {"type": "rgb", "value": 0.3}}
    return mi.load_dict(parts)


def register_merl(mi, dr):
    class Merl(mi.BSDF):
        """Nearest cell of 90 x 90 x 180, sampled by the cosine."""

        def __init__(self, props):
            super().__init__(props)
            cells = np.fromfile(props["filename"], "<f8", offset=12).reshape(3, -1)
            rgb = np.maximum(cells * np.array([[1.0], [1.15], [1.66]]) / 1500, 0)
            self.cells = mi.Float(rgb.T.astype(np.float32).ravel())
            self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
            self.m_flags = self.m_components[0]

        def f(self, wi, wo, active):
            h = dr.normalize(wi + wo)
            xy = dr.sqrt(h.x * h.x + h.y * h.y)
            c = dr.select(xy > 1e-7, h.x / xy, 1)
            s = dr.select(xy > 1e-7, h.y / xy, 0)
            theta_h = dr.atan2(xy, h.z)
            theta_d = dr.atan2(dr.norm(wo - wi), dr.norm(wo + wi))
            x = wo.x * c * h.z + wo.y * s * h.z - wo.z * xy
            y = wo.y * c - wo.x * s
            phi = dr.atan2(y, x)
            phi = dr.select(phi < 0, phi + dr.pi, phi)
            cell = lambda v, n: mi.UInt32(dr.clip(v, 0, n - 1))
            i = cell(dr.sqrt(theta_h * (2 / dr.pi)) * 90, 90)
            j = cell(theta_d * (2 / dr.pi) * 90, 90)
            k = cell(phi / dr.pi * 180, 180)
            at = 3 * (k + 180 * (j + 90 * i))
            return mi.Color3f(*(dr.gather(mi.Float, self.cells, at + c, active) for c in range(3)))

        def sample(self, ctx, si, s1, s2, active=True):
            active = active & (mi.Frame3f.cos_theta(si.wi) > 0)
            bs = dr.zeros(mi.BSDFSample3f)
            bs.wo = mi.warp.square_to_cosine_hemisphere(s2)
            bs.pdf = mi.warp.square_to_cosine_hemisphere_pdf(bs.wo)
            bs.eta = 1.0
            bs.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
            bs.sampled_component = mi.UInt32(0)
            return bs, (self.f(si.wi, bs.wo, active) * dr.pi) & (active & (bs.pdf > 0))

        def both(self, si, wo, active):
            return active & (mi.Frame3f.cos_theta(si.wi) > 0) & (mi.Frame3f.cos_theta(wo) > 0)

        def eval(self, ctx, si, wo, active=True):
            active = self.both(si, wo, active)
            return (self.f(si.wi, wo, active) * mi.Frame3f.cos_theta(wo)) & active

        def pdf(self, ctx, si, wo, active=True):
            active = self.both(si, wo, active)
            return dr.select(active, mi.warp.square_to_cosine_hemisphere_pdf(wo), 0)

        def eval_pdf(self, ctx, si, wo, active=True):
            return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    mi.register_bsdf("merl", lambda props: Merl(props))


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--material", required=True, help="ggx, FILE.bsdf or FILE.binary")
    p.add_argument("--light", choices=["area", "env"], default="area")
    p.add_argument("--width", type=int, default=640)
    p.add_argument("--height", type=int, default=480)
    p.add_argument("--spp", type=int, default=64, help="the larger of the two numbers of samples")
    p.add_argument("--pairs", type=int, default=4)
    p.add_argument("--threads", type=int, default=2)
    p.add_argument("--variant", default="llvm_ad_rgb")
    p.add_argument("--once", action="store_true", help="one image of --spp samples and nothing else")
    p.add_argument("--out", required=True, help="EXR for the mean of all images")
    a = p.parse_args()

    import drjit as dr
    import mitsuba as mi
    dr.set_thread_count(a.threads)
    mi.set_variant(a.variant)
    register_merl(mi, dr)
    s = scene(mi, a)
    if a.once:
        mi.Bitmap(mi.render(s, spp=a.spp, seed=0)).write(a.out)
        return
    seed, total, weight, rows = 0, 0, 0, []
    for spp in (max(1, a.spp // 4), a.spp):
        np.array(mi.render(s, spp=spp, seed=9_000_000 + spp))  # compiles the kernel: not counted
        errors, seconds = [], []
        for _ in range(a.pairs):
            pair = []
            for _ in range(2):
                seed += 1
                start = time.perf_counter()
                pair.append(np.array(mi.render(s, spp=spp, seed=seed), dtype=np.float64))
                seconds.append(time.perf_counter() - start)
            errors.append(float(((pair[0] - pair[1]) ** 2).mean() / 2))
            total, weight = total + spp * (pair[0] + pair[1]), weight + 2 * spp
        rows.append({"spp": spp, "seconds": seconds, "mse": errors})
    image = total / weight
    mi.Bitmap(image.astype(np.float32)).write(a.out)
    print(json.dumps({"version": mi.__version__, "variant": a.variant, "spp_in_all": weight, "rows": rows,
                      "mean_square": float((image ** 2).mean()), "mean": float(image.mean())}))


if __name__ == "__main__":
    main()

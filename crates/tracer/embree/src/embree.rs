//! The few functions of Embree 3 that single rays need, after its header `rtcore.h`.

use glam::Vec3;
use std::ffi::c_void;

#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct RayHit {
    org: [f32; 3],
    tnear: f32,
    dir: [f32; 3],
    time: f32,
    tfar: f32,
    mask: u32,
    id: u32,
    flags: u32,
    ng: [f32; 3],
    u: f32,
    v: f32,
    prim: u32,
    geom: u32,
    inst: u32,
}

#[repr(C)]
struct Context {
    flags: u32,
    filter: *const c_void,
    inst: u32,
}

const INVALID: u32 = u32::MAX;
const GEOMETRY_TRIANGLE: u32 = 0;
const BUFFER_INDEX: u32 = 0;
const BUFFER_VERTEX: u32 = 1;
const FORMAT_UINT3: u32 = 0x5003;
const FORMAT_FLOAT3: u32 = 0x9003;
/// `RTC_SCENE_FLAG_ROBUST`: watertight, as ours is.
const SCENE_ROBUST: u32 = 4;

unsafe extern "C" {
    fn rtcNewDevice(config: *const std::ffi::c_char) -> *mut c_void;
    fn rtcNewScene(device: *mut c_void) -> *mut c_void;
    fn rtcSetSceneFlags(scene: *mut c_void, flags: u32);
    fn rtcNewGeometry(device: *mut c_void, kind: u32) -> *mut c_void;
    fn rtcSetNewGeometryBuffer(
        geometry: *mut c_void,
        kind: u32,
        slot: u32,
        format: u32,
        stride: usize,
        count: usize,
    ) -> *mut c_void;
    fn rtcCommitGeometry(geometry: *mut c_void);
    fn rtcAttachGeometry(scene: *mut c_void, geometry: *mut c_void) -> u32;
    fn rtcCommitScene(scene: *mut c_void);
    fn rtcIntersect1(scene: *mut c_void, context: *mut Context, ray: *mut RayHit);
}

/// A mesh in Embree.
pub struct Scene(*mut c_void);

impl Scene {
    /// One thread builds; `robust` asks for the watertight test.
    pub fn new(positions: &[Vec3], triangles: &[[u32; 3]], robust: bool) -> Self {
        // SAFETY: the calls and buffer sizes are those of Embree's own tutorial for one triangle mesh; index buffers
        // hold 3 u32 a triangle, vertex buffers 3 f32 a position and one more that Embree may read.
        unsafe {
            let device = rtcNewDevice(c"threads=1,set_affinity=0".as_ptr());
            let scene = rtcNewScene(device);
            rtcSetSceneFlags(scene, if robust { SCENE_ROBUST } else { 0 });
            let geometry = rtcNewGeometry(device, GEOMETRY_TRIANGLE);
            let vertices = rtcSetNewGeometryBuffer(
                geometry,
                BUFFER_VERTEX,
                0,
                FORMAT_FLOAT3,
                12,
                positions.len(),
            )
            .cast::<Vec3>();
            std::ptr::copy_nonoverlapping(positions.as_ptr(), vertices, positions.len());
            let indices = rtcSetNewGeometryBuffer(
                geometry,
                BUFFER_INDEX,
                0,
                FORMAT_UINT3,
                12,
                triangles.len(),
            )
            .cast::<[u32; 3]>();
            std::ptr::copy_nonoverlapping(triangles.as_ptr(), indices, triangles.len());
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcCommitScene(scene);
            Self(scene)
        }
    }

    /// Distance and triangle of the nearest hit.
    pub fn nearest(&self, o: Vec3, d: Vec3) -> Option<(f32, u32)> {
        let mut ray = RayHit {
            org: o.to_array(),
            tnear: 0.0,
            dir: d.to_array(),
            time: 0.0,
            tfar: f32::INFINITY,
            mask: u32::MAX,
            id: 0,
            flags: 0,
            ng: [0.0; 3],
            u: 0.0,
            v: 0.0,
            prim: INVALID,
            geom: INVALID,
            inst: INVALID,
        };
        let mut context = Context {
            flags: 0,
            filter: std::ptr::null(),
            inst: INVALID,
        };
        // SAFETY: both structures have the layout of the header and live through the call
        unsafe { rtcIntersect1(self.0, &raw mut context, &raw mut ray) };
        (ray.geom != INVALID).then_some((ray.tfar, ray.prim))
    }
}

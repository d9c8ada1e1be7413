//! The few functions of Embree 4 that the comparison needs, found in a shared library at run time.
//!
//! Layouts and constants after the public headers `rtcore_*.h` of Embree 4.

use accel::Ray;
use libloading::Library;
use std::{
    ffi::{c_char, c_uint, c_void},
    mem::ManuallyDrop,
    path::Path,
    ptr::null_mut,
    sync::atomic::{AtomicIsize, Ordering::Relaxed},
};

type Handle = *mut c_void;
type Monitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;

/// `RTCRayHit`, with room to spare for the fields of later minor versions.
#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct RayHit {
    origin: [f32; 3],
    near: f32,
    direction: [f32; 3],
    time: f32,
    far: f32,
    mask: c_uint,
    id: c_uint,
    flags: c_uint,
    normal: [f32; 3],
    uv: [f32; 2],
    primitive: c_uint,
    geometry: c_uint,
    instance: [c_uint; 2],
    spare: [c_uint; 8],
}

impl RayHit {
    #[inline(always)]
    fn new(ray: &Ray) -> Self {
        Self {
            origin: ray.o.to_array(),
            near: ray.tmin,
            direction: ray.d.to_array(),
            time: 0.0,
            far: ray.tmax,
            mask: c_uint::MAX,
            id: 0,
            flags: 0,
            normal: [0.0; 3],
            uv: [0.0; 2],
            primitive: c_uint::MAX,
            geometry: c_uint::MAX,
            instance: [c_uint::MAX; 2],
            spare: [0; 8],
        }
    }
}

const TRIANGLES: c_uint = 0;
const INDEX_BUFFER: c_uint = 0;
const VERTEX_BUFFER: c_uint = 1;
const FORMAT_UINT3: c_uint = 0x5003;
const FORMAT_FLOAT3: c_uint = 0x9003;

static BYTES: AtomicIsize = AtomicIsize::new(0);

unsafe extern "C" fn count_memory(_: *mut c_void, bytes: isize, _post: bool) -> bool {
    BYTES.fetch_add(bytes, Relaxed);
    true
}

/// A committed scene of one triangle mesh. Device and scene live until the process ends.
pub(crate) struct Scene {
    handle: Handle,
    intersect: unsafe extern "C" fn(Handle, *mut RayHit, *mut c_void),
    occluded: unsafe extern "C" fn(Handle, *mut RayHit, *mut c_void),
    /// What Embree says that it allocated while building and kept.
    pub(crate) bytes: usize,
    /// Never unloaded, as threads of Embree's task scheduler may still be running in it.
    _library: ManuallyDrop<Library>,
}

// SAFETY: Embree allows any number of threads to query a committed scene.
unsafe impl Sync for Scene {}

macro_rules! call {
    ($library:ident, $name:literal, ($($type:ty),*) -> $out:ty, $($arg:expr),*) => {{
        // SAFETY: the name and signature are those of Embree's header; handles come from Embree itself.
        unsafe {
            let function: libloading::Symbol<unsafe extern "C" fn($($type),*) -> $out> =
                $library.get(concat!($name, "\0").as_bytes())?;
            function($($arg),*)
        }
    }};
}

impl Scene {
    /// Builds a scene with the given `RTCBuildQuality` (1 is medium, 2 high) and number of threads.
    pub(crate) fn build(
        library: &Path,
        positions: &[[f32; 3]],
        indices: &[[u32; 3]],
        quality: c_uint,
        threads: usize,
    ) -> Result<Self, libloading::Error> {
        // SAFETY: loading Embree runs only its own initialisers.
        let library = unsafe { Library::new(library)? };
        let config = format!("threads={threads}\0");
        let device = call!(library, "rtcNewDevice", (*const c_char) -> Handle, config.as_ptr().cast());
        BYTES.store(0, Relaxed);
        call!(library, "rtcSetDeviceMemoryMonitorFunction", (Handle, Monitor, *mut c_void) -> (),
            device, count_memory, null_mut());
        let scene = call!(library, "rtcNewScene", (Handle) -> Handle, device);
        let mesh = call!(library, "rtcNewGeometry", (Handle, c_uint) -> Handle, device, TRIANGLES);
        let buffers: [(c_uint, c_uint, *const c_void, usize); 2] = [
            (INDEX_BUFFER, FORMAT_UINT3, indices.as_ptr().cast(), indices.len()),
            (VERTEX_BUFFER, FORMAT_FLOAT3, positions.as_ptr().cast(), positions.len()),
        ];
        for (kind, format, from, count) in buffers {
            let to = call!(library, "rtcSetNewGeometryBuffer",
                (Handle, c_uint, c_uint, c_uint, usize, usize) -> *mut c_void, mesh, kind, 0, format, 12, count);
            // SAFETY: Embree has just allocated `count` items of 12 bytes there.
            unsafe { std::ptr::copy_nonoverlapping(from.cast::<u8>(), to.cast::<u8>(), 12 * count) };
        }
        BYTES.store(0, Relaxed);
        call!(library, "rtcCommitGeometry", (Handle) -> (), mesh);
        call!(library, "rtcAttachGeometry", (Handle, Handle) -> c_uint, scene, mesh);
        call!(library, "rtcSetSceneBuildQuality", (Handle, c_uint) -> (), scene, quality);
        call!(library, "rtcCommitScene", (Handle) -> (), scene);
        // SAFETY: names and signatures are those of Embree's header, and `library` is kept.
        let (intersect, occluded) = unsafe { (*library.get(b"rtcIntersect1\0")?, *library.get(b"rtcOccluded1\0")?) };
        Ok(Self {
            handle: scene,
            intersect,
            occluded,
            bytes: BYTES.load(Relaxed) as usize,
            _library: ManuallyDrop::new(library),
        })
    }

    /// Distance of the nearest hit.
    #[inline(always)]
    pub(crate) fn closest(&self, ray: &Ray) -> Option<f32> {
        let mut query = RayHit::new(ray);
        // SAFETY: `query` starts with an RTCRayHit, initialised and aligned; null asks for default arguments.
        unsafe { (self.intersect)(self.handle, &raw mut query, null_mut()) };
        (query.geometry != c_uint::MAX).then_some(query.far)
    }

    /// Whether the ray hits anything.
    #[inline(always)]
    pub(crate) fn occluded(&self, ray: &Ray) -> bool {
        let mut query = RayHit::new(ray);
        // SAFETY: `query` starts with an RTCRay, initialised and aligned; null asks for default arguments.
        unsafe { (self.occluded)(self.handle, &raw mut query, null_mut()) };
        query.far < 0.0
    }
}

//! Memory in huge pages: rays without order miss the look-aside buffer at nearly every node of a large tree otherwise.

use bytemuck::Pod;
use memmap2::{MmapMut, MmapOptions};
use std::marker::PhantomData;

/// Trees smaller than a huge page gain nothing.
const HUGE: usize = 2 << 20;

/// A list that never changes.
#[derive(Debug)]
pub(super) enum Pages<T> {
    /// Where it is small, or the system gave no mapping.
    Heap(Vec<T>),
    /// Where it is large.
    Mapped(Mapping, PhantomData<T>),
}

/// Anonymous memory that begins with `bytes` bytes of a list.
#[derive(Debug)]
pub(super) struct Mapping {
    memory: MmapMut,
    bytes: usize,
}

impl<T: Pod> Pages<T> {
    pub(super) fn new(list: Vec<T>) -> Self {
        let bytes: &[u8] = bytemuck::cast_slice(&list);
        match mapped(bytes) {
            Some(mapping) => Self::Mapped(mapping, PhantomData),
            None => Self::Heap(list),
        }
    }

    #[inline]
    pub(super) fn as_slice(&self) -> &[T] {
        match self {
            Self::Heap(list) => list,
            // pages are aligned for any of the types here
            Self::Mapped(mapping, _) => bytemuck::cast_slice(&mapping.memory[..mapping.bytes]),
        }
    }
}

/// A copy in a mapping of its own; `None` if the list is small or there is no such memory.
fn mapped(list: &[u8]) -> Option<Mapping> {
    if list.len() < HUGE {
        return None;
    }
    let mut memory = MmapOptions::new().len(list.len()).map_anon().ok()?;
    // a wish: without it everything works, more slowly
    #[cfg(target_os = "linux")]
    let _ = memory.advise(memmap2::Advice::HugePage);
    memory[..list.len()].copy_from_slice(list);
    Some(Mapping {
        memory,
        bytes: list.len(),
    })
}

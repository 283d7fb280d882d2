//! Memory in huge pages. Reads without order miss the look-aside buffer at nearly every access otherwise, and memory that
//! is touched once costs one fault for 2 MiB instead of 512.

use bytemuck::Pod;
use memmap2::{MmapMut, MmapOptions};
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};

/// What is smaller than a huge page gains nothing, bytes.
const HUGE: usize = 2 << 20;

/// A list of fixed length, in huge pages where it is large and the system has them.
///
/// Linux is asked for them (`madvise`); elsewhere, or where none are free, it is ordinary memory.
pub struct Pages<T>(Memory<T>);

enum Memory<T> {
    /// Where it is small, or the system gave no mapping.
    Heap(Vec<T>),
    /// Anonymous memory that begins with so many bytes of the list.
    Mapped(MmapMut, usize, PhantomData<T>),
}

impl<T: Pod> Pages<T> {
    /// `count` times zero; memory is taken when it is first written.
    #[must_use]
    pub fn zeroed(count: usize) -> Self {
        let mapped = count.checked_mul(size_of::<T>()).and_then(map);
        Self(mapped.unwrap_or_else(|| Memory::Heap(vec![T::zeroed(); count])))
    }
}

fn map<T>(bytes: usize) -> Option<Memory<T>> {
    if bytes < HUGE {
        return None;
    }
    let memory = MmapOptions::new().len(bytes).map_anon().ok()?;
    // a wish: without it everything works, more slowly
    #[cfg(target_os = "linux")]
    let _ = memory.advise(memmap2::Advice::HugePage);
    Some(Memory::Mapped(memory, bytes, PhantomData))
}

impl<T: Pod> From<Vec<T>> for Pages<T> {
    /// Copies what is large.
    fn from(list: Vec<T>) -> Self {
        match map(size_of_val(list.as_slice())) {
            Some(mapped) => {
                let mut pages = Self(mapped);
                pages.copy_from_slice(&list);
                pages
            }
            None => Self(Memory::Heap(list)),
        }
    }
}

impl<T: Pod> Deref for Pages<T> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        match &self.0 {
            Memory::Heap(list) => list,
            // pages are aligned for any plain type
            Memory::Mapped(memory, bytes, _) => bytemuck::cast_slice(&memory[..*bytes]),
        }
    }
}

impl<T: Pod> DerefMut for Pages<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        match &mut self.0 {
            Memory::Heap(list) => list,
            Memory::Mapped(memory, bytes, _) => bytemuck::cast_slice_mut(&mut memory[..*bytes]),
        }
    }
}

impl<T: Pod> Clone for Pages<T> {
    fn clone(&self) -> Self {
        let mut copy = Self::zeroed(self.len());
        copy.copy_from_slice(self);
        copy
    }
}

impl<T: Pod + PartialEq> PartialEq for Pages<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: Pod + fmt::Debug> fmt::Debug for Pages<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_on_both_sides_of_a_huge_page_hold_what_they_are_given() {
        for count in [0, 1, HUGE / 8 - 1, HUGE / 8, HUGE / 8 + 1] {
            let list: Vec<u64> = (0..count as u64).map(|k| k * k).collect();
            let mut pages = Pages::<u64>::zeroed(count);
            assert!(pages.iter().all(|v| *v == 0), "{count} zeros");
            pages.copy_from_slice(&list);
            assert!(pages == Pages::from(list.clone()), "{count} from a list");
            assert_eq!(*pages.clone(), *list, "{count} copied");
        }
    }
}

//! The film: sums per pixel and replicate, tile by tile.

use crate::estimate::Sums;
use brdf::Pages;
use rayon::prelude::*;

/// Edge of a tile in pixels.
pub(crate) const TILE: u32 = 16;

/// Sums of samples for every pixel and replicate.
///
/// Sample `s` of a pixel belongs to replicate `s % replicates`. Replicates are independent scrambles of the points,
/// so their spread tells the error of the picture. Sums are f64: added one by one, they are the same bits wherever a
/// render was interrupted. Size: `8 * N * replicates` bytes a pixel, in huge pages.
#[derive(Clone, Debug, PartialEq)]
pub struct Film<const N: usize> {
    width: u32,
    height: u32,
    replicates: u32,
    squares: Vec<Square>,
    /// Of all squares, one after the other: by pixel (row after row of the square), then by replicate, then by channel.
    sums: Pages<f64>,
}

/// Where a tile lies, and how far it is.
#[derive(Clone, Debug, PartialEq)]
struct Square {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
    replicates: u32,
    done: u32,
    /// Of its first sum.
    first: usize,
    seen: Seen,
}

/// What was found in a tile's sums while they were in the cache.
#[derive(Clone, Debug, Default)]
struct Seen(Option<Sums>);

impl PartialEq for Seen {
    /// It follows from the sums.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A square of the film.
#[derive(Clone, Copy, Debug)]
pub struct Tile<'a, const N: usize> {
    square: &'a Square,
    sums: &'a [[f64; N]],
}

/// A square of the film on which samples are put.
pub(crate) struct TileMut<'a, const N: usize> {
    square: &'a mut Square,
    sums: &'a mut [[f64; N]],
}

/// How many samples a pixel each replicate holds.
#[derive(Clone, Debug)]
pub(crate) struct Counts {
    /// Replicates that hold any: which, how many, and the inverse of that, since divisions are what an estimate costs.
    pub(crate) used: Vec<(usize, f64, f64)>,
    /// Samples in all.
    pub(crate) samples: f64,
}

impl Counts {
    pub(crate) fn new(samples: impl Iterator<Item = u32>) -> Self {
        let samples = samples.map(f64::from);
        let used: Vec<_> = (samples.enumerate())
            .filter(|(_, n)| *n > 0.0)
            .map(|(r, n)| (r, n, 1.0 / n))
            .collect();
        Self {
            samples: used.iter().map(|u| u.1).sum(),
            used,
        }
    }
}

/// Why stored sums don't fit a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("tile {tile}: expected {expected} sums, found {found}")]
pub struct RestoreError {
    /// Which tile.
    pub tile: usize,
    /// Sums it has.
    pub expected: usize,
    /// Sums it was given.
    pub found: usize,
}

impl<const N: usize> Film<N> {
    /// An empty film of `width` x `height` pixels; counts below one are taken as one.
    ///
    /// More replicates know the error better; fewer keep more of the evenness of low-discrepancy points. 8 is usual.
    #[must_use]
    pub fn new(width: u32, height: u32, replicates: u32) -> Self {
        let (width, height, replicates) = (width.max(1), height.max(1), replicates.max(1));
        let (mut squares, mut first) = (Vec::new(), 0);
        for y in (0..height).step_by(TILE as usize) {
            for x in (0..width).step_by(TILE as usize) {
                let square = Square {
                    x,
                    y,
                    width: TILE.min(width - x),
                    height: TILE.min(height - y),
                    replicates,
                    done: 0,
                    first,
                    seen: Seen(None),
                };
                first += square.sums();
                squares.push(square);
            }
        }
        Self {
            width,
            height,
            replicates,
            squares,
            sums: Pages::zeroed(first * N),
        }
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Bytes of its sums: `8 * N * replicates` a pixel.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.sums)
    }

    /// Independent scrambles.
    #[must_use]
    pub fn replicates(&self) -> u32 {
        self.replicates
    }

    /// The tiles, row after row: all the state there is.
    pub fn tiles(&self) -> impl ExactSizeIterator<Item = Tile<'_, N>> {
        self.squares.iter().map(|square| self.tile(square))
    }

    fn tile<'a>(&'a self, square: &'a Square) -> Tile<'a, N> {
        let (sums, _) = self.sums.as_chunks::<N>();
        Tile {
            square,
            sums: &sums[square.first..square.first + square.sums()],
        }
    }

    /// The tiles, to put samples on.
    pub(crate) fn tiles_mut(&mut self) -> Vec<TileMut<'_, N>> {
        let (mut rest, _) = self.sums.as_chunks_mut::<N>();
        let tiles = self.squares.iter_mut().map(|square| {
            let (sums, later) = std::mem::take(&mut rest).split_at_mut(square.sums());
            rest = later;
            TileMut { square, sums }
        });
        tiles.collect()
    }

    /// What the estimate needs of each tile, from the tile itself where it was not seen before.
    pub(crate) fn seen(&self) -> Vec<Sums> {
        let of = |square: &Square| (square.seen.0).unwrap_or_else(|| Sums::of(self.tile(square)));
        self.squares.par_iter().map(of).collect()
    }

    /// Puts back the state of tile `index` that [`Tile::done`] and [`Tile::sums`] once gave.
    ///
    /// # Errors
    /// If there is no such tile or the number of sums is not the tile's.
    pub fn restore(
        &mut self,
        index: usize,
        done: u32,
        sums: &[[f64; N]],
    ) -> Result<(), RestoreError> {
        let expected = self.squares.get(index).map_or(0, Square::sums);
        match self.squares.get_mut(index) {
            Some(square) if expected == sums.len() => {
                (square.done, square.seen) = (done, Seen(None));
                let (all, _) = self.sums.as_chunks_mut::<N>();
                all[square.first..square.first + expected].copy_from_slice(sums);
                Ok(())
            }
            _ => Err(RestoreError {
                tile: index,
                expected,
                found: sums.len(),
            }),
        }
    }

    /// Samples a pixel that every tile has.
    #[must_use]
    pub fn spp(&self) -> u32 {
        self.squares.iter().map(|t| t.done).min().unwrap_or(0)
    }

    /// Samples in all.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.squares
            .iter()
            .map(|t| u64::from(t.done) * u64::from(t.width * t.height))
            .sum()
    }

    /// The picture, row after row from the top; zero where there are no samples yet.
    #[must_use]
    pub fn mean(&self) -> Vec<[f64; N]> {
        self.map([0.0; N], |counts, sums| {
            let mut total = [0.0; N];
            for sum in sums {
                for c in 0..N {
                    total[c] += sum[c];
                }
            }
            total.map(|t| t / counts.samples.max(1.0))
        })
    }

    /// The film in other channels: `rows[c]` is what one unit of channel `c` adds to each of them.
    ///
    /// Linear, so that every replicate is what it would have been, had it been recorded in those channels.
    #[must_use]
    pub fn mapped<const M: usize>(&self, rows: &[[f64; M]; N]) -> Film<M> {
        let mut film = Film::new(self.width, self.height, self.replicates);
        let to = film.tiles_mut().into_par_iter();
        to.zip(&self.squares).for_each(|(to, from)| {
            to.square.done = from.done;
            for (out, sum) in to.sums.iter_mut().zip(self.tile(from).sums) {
                for (value, row) in sum.iter().zip(rows) {
                    for (o, weight) in out.iter_mut().zip(row) {
                        *o += value * weight;
                    }
                }
            }
        });
        film
    }

    /// One value a pixel, row after row, from the samples of replicates and their sums; rows of tiles in parallel.
    pub(crate) fn map<T: Clone + Send>(
        &self,
        empty: T,
        f: impl Fn(&Counts, &[[f64; N]]) -> T + Sync,
    ) -> Vec<T> {
        self.map2((empty, ()), |counts, sums| (f(counts, sums), ()))
            .0
    }

    /// Two values a pixel, as [`Self::map`].
    pub(crate) fn map2<A: Clone + Send, B: Clone + Send>(
        &self,
        empty: (A, B),
        f: impl Fn(&Counts, &[[f64; N]]) -> (A, B) + Sync,
    ) -> (Vec<A>, Vec<B>) {
        let width = self.width as usize;
        let pixels = width * self.height as usize;
        let (mut a, mut b) = (vec![empty.0; pixels], vec![empty.1; pixels]);
        let band = width * TILE as usize;
        let bands = a.par_chunks_mut(band).zip(b.par_chunks_mut(band));
        let rows = self.squares.par_chunks(width.div_ceil(TILE as usize));
        bands.zip(rows).for_each(|((a, b), squares)| {
            for tile in squares.iter().map(|square| self.tile(square)) {
                let counts = tile.counts();
                for ((x, y), sums) in tile.pixels().zip(tile.by_pixel()) {
                    let at = (y % TILE) as usize * width + x as usize;
                    (a[at], b[at]) = f(&counts, sums);
                }
            }
        });
        (a, b)
    }
}

impl Square {
    /// How many sums it has.
    fn sums(&self) -> usize {
        (self.width * self.height * self.replicates) as usize
    }

    fn pixels(&self) -> impl ExactSizeIterator<Item = (u32, u32)> + use<> {
        let (x, y, width) = (self.x, self.y, self.width);
        (0..self.width * self.height).map(move |i| (x + i % width, y + i / width))
    }

    fn samples_of(&self, r: u32) -> u32 {
        (self.done + self.replicates - 1 - r.min(self.replicates - 1)) / self.replicates
    }
}

impl<'a, const N: usize> Tile<'a, N> {
    /// Samples a pixel it holds.
    #[must_use]
    pub fn done(&self) -> u32 {
        self.square.done
    }

    /// Sums by pixel (row after row of the tile), then by replicate.
    #[must_use]
    pub fn sums(&self) -> &'a [[f64; N]] {
        self.sums
    }

    pub(crate) fn replicates(&self) -> u32 {
        self.square.replicates
    }

    /// How many samples a pixel replicate `r` holds.
    #[must_use]
    pub fn samples_of(&self, r: u32) -> u32 {
        self.square.samples_of(r)
    }

    /// The samples of its replicates.
    pub(crate) fn counts(&self) -> Counts {
        Counts::new((0..self.square.replicates).map(|r| self.samples_of(r)))
    }

    /// The sums of each pixel by replicate.
    pub(crate) fn by_pixel(&self) -> impl Iterator<Item = &'a [[f64; N]]> {
        self.sums.chunks_exact(self.square.replicates as usize)
    }

    /// Coordinates of its pixels in the picture, row after row.
    pub fn pixels(&self) -> impl ExactSizeIterator<Item = (u32, u32)> + use<N> {
        self.square.pixels()
    }
}

impl<const N: usize> TileMut<'_, N> {
    /// Samples a pixel it holds.
    pub(crate) fn done(&self) -> u32 {
        self.square.done
    }

    /// Coordinates of its pixels in the picture, row after row.
    pub(crate) fn pixels(&self) -> impl ExactSizeIterator<Item = (u32, u32)> + use<N> {
        self.square.pixels()
    }

    /// Adds `count` samples of every pixel, of which the first has number `first`: `light(i, pixel)` is the light of the
    /// `i`-th. Pixel by pixel, since the sums of a pixel are neighbours.
    #[inline(always)]
    pub(crate) fn add(&mut self, first: u32, count: u32, light: impl Fn(u32, usize) -> [f32; N]) {
        let replicates = self.square.replicates;
        let pixels = self.sums.chunks_exact_mut(replicates as usize);
        for (pixel, sums) in pixels.enumerate() {
            let mut r = first % replicates;
            for i in 0..count {
                let light = light(i, pixel);
                for c in 0..N {
                    sums[r as usize][c] += f64::from(light[c]);
                }
                r = if r + 1 == replicates { 0 } else { r + 1 };
            }
        }
        (self.square.done, self.square.seen) = (first + count, Seen(None));
    }

    /// Looks at the sums while they are in the cache.
    pub(crate) fn see(&mut self) {
        let tile = Tile {
            square: self.square,
            sums: self.sums,
        };
        let seen = Sums::of(tile);
        self.square.seen = Seen(Some(seen));
    }
}

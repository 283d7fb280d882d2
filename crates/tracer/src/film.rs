//! The film: sums per pixel and replicate, tile by tile.

use rayon::prelude::*;

/// Edge of a tile in pixels.
pub(crate) const TILE: u32 = 16;

/// Sums of samples for every pixel and replicate.
///
/// Sample `s` of a pixel belongs to replicate `s % replicates`. Replicates are independent scrambles of the points,
/// so their spread tells the error of the picture. Sums are f64: added one by one, they are the same bits wherever a
/// render was interrupted. Size: `8 * N * replicates` bytes a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Film<const N: usize> {
    width: u32,
    height: u32,
    replicates: u32,
    pub(crate) tiles: Vec<Tile<N>>,
}

/// A square of the film.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile<const N: usize> {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
    replicates: u32,
    pub(crate) done: u32,
    sums: Vec<[f64; N]>,
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
        let mut tiles = Vec::new();
        for y in (0..height).step_by(TILE as usize) {
            for x in (0..width).step_by(TILE as usize) {
                let (w, h) = (TILE.min(width - x), TILE.min(height - y));
                tiles.push(Tile {
                    x,
                    y,
                    width: w,
                    height: h,
                    replicates,
                    done: 0,
                    sums: vec![[0.0; N]; (w * h * replicates) as usize],
                });
            }
        }
        Self {
            width,
            height,
            replicates,
            tiles,
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
        self.tiles.iter().map(|t| size_of_val(&t.sums[..])).sum()
    }

    /// Independent scrambles.
    #[must_use]
    pub fn replicates(&self) -> u32 {
        self.replicates
    }

    /// The tiles, row after row: all the state there is.
    #[must_use]
    pub fn tiles(&self) -> &[Tile<N>] {
        &self.tiles
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
        let expected = self.tiles.get(index).map_or(0, |t| t.sums.len());
        match self.tiles.get_mut(index) {
            Some(tile) if expected == sums.len() => {
                tile.done = done;
                tile.sums.copy_from_slice(sums);
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
        self.tiles.iter().map(|t| t.done).min().unwrap_or(0)
    }

    /// Samples in all.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.tiles
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
        let map = |sum: &[f64; N]| {
            let mut out = [0.0; M];
            for (value, row) in sum.iter().zip(rows) {
                for (o, weight) in out.iter_mut().zip(row) {
                    *o += value * weight;
                }
            }
            out
        };
        let tile = |t: &Tile<N>| Tile {
            x: t.x,
            y: t.y,
            width: t.width,
            height: t.height,
            replicates: t.replicates,
            done: t.done,
            sums: t.sums.iter().map(map).collect(),
        };
        Film {
            width: self.width,
            height: self.height,
            replicates: self.replicates,
            tiles: self.tiles.par_iter().map(tile).collect(),
        }
    }

    /// One value a pixel, row after row, from the samples of replicates and their sums; rows of tiles in parallel.
    pub(crate) fn map<T: Clone + Send>(
        &self,
        empty: T,
        f: impl Fn(&Counts, &[[f64; N]]) -> T + Sync,
    ) -> Vec<T> {
        let width = self.width as usize;
        let mut out = vec![empty; width * self.height as usize];
        let bands = out.par_chunks_mut(width * TILE as usize);
        let tiles = self.tiles.par_chunks(width.div_ceil(TILE as usize));
        bands.zip(tiles).for_each(|(band, tiles)| {
            for tile in tiles {
                let counts = tile.counts();
                for ((x, y), sums) in tile.pixels().zip(tile.by_pixel()) {
                    band[(y % TILE) as usize * width + x as usize] = f(&counts, sums);
                }
            }
        });
        out
    }
}

impl<const N: usize> Tile<N> {
    /// Samples a pixel it holds.
    #[must_use]
    pub fn done(&self) -> u32 {
        self.done
    }

    /// Sums by pixel (row after row of the tile), then by replicate.
    #[must_use]
    pub fn sums(&self) -> &[[f64; N]] {
        &self.sums
    }

    pub(crate) fn replicates(&self) -> u32 {
        self.replicates
    }

    /// How many samples a pixel replicate `r` holds.
    #[must_use]
    pub fn samples_of(&self, r: u32) -> u32 {
        (self.done + self.replicates - 1 - r.min(self.replicates - 1)) / self.replicates
    }

    /// The samples of its replicates.
    pub(crate) fn counts(&self) -> Counts {
        Counts::new((0..self.replicates).map(|r| self.samples_of(r)))
    }

    /// The sums of each pixel by replicate.
    pub(crate) fn by_pixel(&self) -> impl Iterator<Item = &[[f64; N]]> {
        self.sums.chunks_exact(self.replicates as usize)
    }

    /// Coordinates of its pixels in the picture, row after row.
    pub fn pixels(&self) -> impl ExactSizeIterator<Item = (u32, u32)> + use<N> {
        let (x, y, width) = (self.x, self.y, self.width);
        (0..self.width * self.height).map(move |i| (x + i % width, y + i / width))
    }

    /// Adds sample number `sample` of every pixel.
    pub(crate) fn add(&mut self, sample: u32, light: impl Iterator<Item = [f32; N]>) {
        let (replicates, r) = (
            self.replicates as usize,
            (sample % self.replicates) as usize,
        );
        for (sums, light) in self.sums.chunks_exact_mut(replicates).zip(light) {
            for c in 0..N {
                sums[r][c] += f64::from(light[c]);
            }
        }
    }
}

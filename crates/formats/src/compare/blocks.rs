//! Means of square blocks: noise averages out in them, bias does not.

use crate::image::RgbImage32;

/// What of a block is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// The mean of the channels.
    Grey,
    /// The worst of R, G and B.
    Worst,
}

/// A block of which at least half was compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Column of its first pixel.
    pub x: u32,
    /// Row of its first pixel.
    pub y: u32,
    /// Means of R, G, B of the picture.
    pub image: [f64; 3],
    /// Means of R, G, B of the reference.
    pub reference: [f64; 3],
}

impl Block {
    /// (picture − reference) / reference: 0 where both are black, not finite where only the reference is. For
    /// [`Channel::Worst`] the one of largest size.
    pub fn relative(&self, channel: Channel) -> f64 {
        let relative = |x: f64, r: f64| if x == r { 0.0 } else { (x - r) / r };
        match channel {
            Channel::Grey => relative(self.image.iter().sum(), self.reference.iter().sum()),
            Channel::Worst => {
                let all = [0, 1, 2].map(|c| relative(self.image[c], self.reference[c]));
                all.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
            }
        }
    }
}

/// The blocks of a comparison.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockGrid {
    /// Edge of a block in pixels; blocks at the right and lower border may be smaller.
    pub size: u32,
    /// The blocks, row by row, without those mostly left out.
    pub blocks: Vec<Block>,
}

impl BlockGrid {
    pub(super) fn new(image: &RgbImage32, reference: &RgbImage32, kept: &[bool], size: u32) -> Self {
        let (width, height, edge) = (image.width as usize, image.height as usize, size as usize);
        let mut blocks = Vec::new();
        for y in (0..height).step_by(edge) {
            for x in (0..width).step_by(edge) {
                let rows = y..(y + edge).min(height);
                let columns = x..(x + edge).min(width);
                let all = rows.len() * columns.len();
                let inside = rows.flat_map(|y| columns.clone().map(move |x| y * width + x));
                let used: Vec<usize> = inside.filter(|i| kept[*i]).collect();
                if 2 * used.len() >= all && !used.is_empty() {
                    let mean = |i: &RgbImage32| {
                        [0, 1, 2]
                            .map(|c| used.iter().map(|p| f64::from(i.data[*p][c])).sum::<f64>() / used.len() as f64)
                    };
                    blocks.push(Block { x: x as u32, y: y as u32, image: mean(image), reference: mean(reference) });
                }
            }
        }
        Self { size, blocks }
    }

    /// The part of the blocks that differ by more than `relative` (0.05 is 5 %); 0 if there are no blocks.
    pub fn fraction_above(&self, relative: f64, channel: Channel) -> f64 {
        // A reference of zero gives infinity, which is above any limit.
        let above = self.blocks.iter().filter(|b| b.relative(channel).abs() > relative).count();
        above as f64 / self.blocks.len().max(1) as f64
    }

    /// The block that differs most; `None` if there are no blocks.
    pub fn worst(&self, channel: Channel) -> Option<&Block> {
        self.blocks.iter().max_by(|a, b| a.relative(channel).abs().total_cmp(&b.relative(channel).abs()))
    }
}

//! The only source of randomness: numbers that are a function of (seed, domain, pass, index).
//!
//! The first dimensions are pairs of an Owen-scrambled (0,2)-sequence, each pair with its own shuffle of the index, so
//! that pairs are well spread by themselves and independent of each other (Burley 2020, "Practical Hash-based Owen
//! Scrambling"). After the first draws, where stratification no longer helps, they are hashed counters.

/// Which family of paths draws numbers; keeps their streams apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Camera paths; `index` is the pixel, stratified over passes.
    Camera,
    /// Light paths; `index` is the path, stratified over the paths of a pass.
    Light,
    /// Training and measurement before the first pass; stratified as light paths are.
    Prepare,
    /// What is chosen once for a whole pass; `index` is the pass, stratified over passes.
    Pass,
    /// Moves of Markov chains; `index` is the chain.
    Chain,
}

/// Draws (1-D or 2-D) that come from the scrambled sequence.
const STRATIFIED: u32 = 24;

/// How far the early draws of a stream are moved, on the circle that [0, 1) is when its ends are joined: the state of a Markov
/// chain, beside the stream that it began with.
#[derive(Clone, Debug)]
pub struct Moves([[u32; 2]; STRATIFIED as usize]);

/// The narrowest and the widest step, as powers of two.
const STEP_LOG2: [f32; 2] = [-18.0, -1.0];

impl Moves {
    /// The stream as it is.
    pub fn none() -> Self {
        Self([[0; 2]; STRATIFIED as usize])
    }
    /// A step onwards from here, as likely as the step back.
    ///
    /// Each draw moves by a size of its own, of all magnitudes alike, so that most stay about where they are (Kelemen et al. 2002,
    /// "A Simple and Robust Mutation Strategy for the Metropolis Light Transport Algorithm", section 3.3, has one size for all):
    /// paths bear wide steps of some numbers and only narrow ones of others. In a caustic close up that left a third of the
    /// noise variance of one size for all.
    pub fn step(&self, random: &mut Sampler) -> Self {
        let [least, most] = STEP_LOG2;
        Self(self.0.map(|pair| {
            let size = (least + (most - least) * random.next_1d()).exp2();
            pair.map(|at| at.wrapping_add(((2.0 * random.next_1d() - 1.0) * size * 2f32.powi(32)) as i32 as u32))
        }))
    }
}

/// One stream of uniform numbers in [0, 1).
#[derive(Clone, Copy, Debug)]
pub struct Sampler<'m> {
    /// Position in the low-discrepancy sequence, its bits reversed.
    point: u32,
    /// Scrambling key of this stream.
    key: u32,
    /// Draws made so far.
    draw: u32,
    /// State of the counter-based generator for late draws.
    late: u64,
    moves: Option<&'m Moves>,
}

impl<'m> Sampler<'m> {
    /// The stream of path `index` in pass `pass`.
    ///
    /// Camera paths of one pixel share a scramble and walk the sequence from pass to pass; light paths of one pass share
    /// a scramble and walk it from path to path.
    pub fn new(seed: u64, domain: Domain, pass: u64, index: u64) -> Self {
        let family = mix64(seed ^ mix64(domain as u64 + 1));
        let (stream, point) = if domain == Domain::Camera { (index, pass) } else { (pass, index) };
        let key = mix64(family.wrapping_add(mix64(stream ^ 0x9e37_79b9_7f4a_7c15)));
        let late = mix64(key ^ mix64(point.wrapping_add(0x632b_e59b_d9b4_e019)));
        Self {
            point: (point as u32).reverse_bits(),
            key: (key >> 32) as u32 ^ ((point >> 32) as u32),
            draw: 0,
            late,
            moves: None,
        }
    }

    /// The stream with its early draws moved; late ones stay.
    pub fn moved(self, moves: &'m Moves) -> Self {
        Self { moves: Some(moves), ..self }
    }

    /// One number in [0, 1).
    #[inline]
    pub fn next_1d(&mut self) -> f32 {
        let Some((index, k)) = self.next_draw() else { return unit(self.next_late()) };
        unit(self.place(0, scramble(index, k ^ 0x68bc_21eb).reverse_bits()))
    }

    /// Two numbers in [0, 1), stratified together.
    #[inline]
    pub fn next_2d(&mut self) -> glam::Vec2 {
        let Some((index, k)) = self.next_draw() else {
            return glam::Vec2::new(unit(self.next_late()), unit(self.next_late()));
        };
        let x = scramble(index, k ^ 0x68bc_21eb);
        let y = scramble(sobol_second(index), k ^ 0x02e5_be93);
        let turned = (u64::from(x) << 32 | u64::from(y)).reverse_bits();
        glam::Vec2::new(unit(self.place(0, turned as u32)), unit(self.place(1, (turned >> 32) as u32)))
    }

    /// A coordinate of the last draw where it was moved to.
    #[inline]
    fn place(&self, coordinate: usize, word: u32) -> u32 {
        self.moves.map_or(word, |m| word.wrapping_add(m.0[self.draw as usize - 1][coordinate]))
    }

    /// In place of a draw of either kind that nobody will look at: 0, and the draws after it stay what they are as long as
    /// they are stratified.
    #[inline]
    pub fn skip(&mut self) -> f32 {
        self.draw += 1;
        0.0
    }
    /// [`Sampler::skip`], so many times.
    #[inline]
    pub fn skip_many(&mut self, draws: u32) {
        self.draw += draws;
    }

    /// The shuffled index and the key of the next stratified draw; `None` past the last one.
    #[inline]
    fn next_draw(&mut self) -> Option<(u32, u32)> {
        let draw = self.draw;
        self.draw += 1;
        (draw < STRATIFIED).then(|| {
            let k = mix32(self.key.wrapping_add(draw.wrapping_mul(0x9e37_79b9)));
            // Owen scrambling of the index maps aligned power-of-two blocks onto such blocks, and each of those is a net.
            (scramble(self.point, k).reverse_bits(), mix32(k ^ 0x5bd1_e995))
        })
    }

    /// A fresh 32-bit word: SplitMix64 (Steele, Lea & Flood 2014) keyed by the stream.
    #[inline]
    fn next_late(&mut self) -> u32 {
        self.late = self.late.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (mix64(self.late) >> 32) as u32
    }
}

/// A number in [0, 1) for a choice that all paths of a pass share, such that a *quarter turn* of it (its sum with 1/4, 1/2
/// and 3/4, modulo 1) is spread evenly, too.
///
/// Passes `0..2ᵏ` walk an even lattice from k = 4 on, moved as a whole by the seed. Any four passes that begin at a multiple
/// of four fall into four different quarters, and at four different places of them, so that with all turns they are a
/// lattice of 16.
pub(crate) fn pass_turn(seed: u64, pass: u64) -> f32 {
    let shift = mix64(seed ^ mix64(0x7c3a_19f5_0b6d_e284)) as u32;
    let index = pass as u32;
    let pair = |bits: u32| (bits & 1) << 1 | bits >> 1 & 1;
    let place = pair(index) << 30 | (index >> 4).reverse_bits() >> 2;
    let quarter = pair(index) ^ pair(index >> 2);
    unit((quarter << 30 | place >> 2).wrapping_add(shift))
}

/// 24 random bits as a float in [0, 1).
#[inline]
pub(crate) fn unit(x: u32) -> f32 {
    (x >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// Nested uniform scramble of the bits of `v`, least significant first: the hash of Laine & Karras 2011 with the constants of
/// Vegdahl 2021, "Building a Better LK Hash". Points of a sequence have their first bit on top; they come here, and leave,
/// with their bits reversed.
#[inline]
fn scramble(mut v: u32, seed: u32) -> u32 {
    v ^= v.wrapping_mul(0x3d20_adea);
    v = v.wrapping_add(seed);
    v = v.wrapping_mul((seed >> 16) | 1);
    v ^= v.wrapping_mul(0x0552_6c56);
    v ^ v.wrapping_mul(0x53a2_2864)
}

/// Second dimension of the Sobol' sequence as a 32-bit fraction with its bits reversed: its generator matrix is Pascal's
/// triangle modulo 2, which factors into five shifts.
#[inline]
fn sobol_second(index: u32) -> u32 {
    let mut v = index;
    v ^= (v >> 16) & 0x0000_ffff;
    v ^= (v >> 8) & 0x00ff_00ff;
    v ^= (v >> 4) & 0x0f0f_0f0f;
    v ^= (v >> 2) & 0x3333_3333;
    v ^ (v >> 1) & 0x5555_5555
}

/// Bijective 32-bit finaliser (constants of Wellons 2018, "prospecting for hash functions", lowbias32).
#[inline]
fn mix32(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Bijective 64-bit finaliser of `SplitMix64`.
#[inline]
pub(crate) fn mix64(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_fill_every_elementary_interval_once() {
        for draw in 0..5 {
            for log_x in 0..=6u32 {
                let mut seen = [0u8; 64];
                for path in 0..64 {
                    let mut s = Sampler::new(7, Domain::Light, 3, path);
                    (0..draw).for_each(|_| _ = s.next_1d());
                    let u = s.next_2d();
                    let (nx, ny) = (1u32 << log_x, 64u32 >> log_x);
                    let cell = (u.x * nx as f32) as u32 * ny + (u.y * ny as f32) as u32;
                    seen[cell as usize] += 1;
                }
                assert!(seen.iter().all(|&c| c == 1), "draw {draw}, 2^{log_x} columns: {seen:?}");
            }
        }
    }

    #[test]
    fn draws_and_streams_are_uncorrelated() {
        let n = 4096;
        let corr = |a: &[f32], b: &[f32]| {
            let s: f64 = a.iter().zip(b).map(|(x, y)| f64::from((x - 0.5) * (y - 0.5))).sum();
            (s / n as f64 * 12.0).abs()
        };
        let column = |pass: u64, draw: usize| -> Vec<f32> {
            (0..n)
                .map(|i| {
                    let mut s = Sampler::new(1, Domain::Light, pass, i);
                    (0..draw).for_each(|_| _ = s.next_1d());
                    s.next_1d()
                })
                .collect()
        };
        let late = STRATIFIED as usize + 3;
        for (a, b) in [
            ((0, 0), (0, 1)),
            ((0, 0), (0, 5)),
            ((0, 0), (1, 0)),
            ((0, 1), (0, late)),
            ((0, late), (0, late + 1)),
            ((0, late), (1, late)),
        ] {
            let c = corr(&column(a.0, a.1), &column(b.0, b.1));
            assert!(c < 5.0 / (n as f64).sqrt(), "{a:?} {b:?}: {c}");
        }
    }

    #[test]
    fn a_draw_that_is_skipped_leaves_the_next_ones_as_they_are() {
        let (mut drawn, mut skipped) = (Sampler::new(3, Domain::Light, 1, 77), Sampler::new(3, Domain::Light, 1, 77));
        for _ in 0..STRATIFIED / 2 {
            drawn.next_1d();
            skipped.skip();
            assert_eq!(drawn.next_2d(), skipped.next_2d());
        }
    }

    #[test]
    fn moves_shift_early_draws_alone_and_stay_even() {
        let mut random = Sampler::new(9, Domain::Chain, 0, 0);
        let (mut moves, plain) = (Moves::none(), Sampler::new(3, Domain::Light, 1, 77));
        let draw = |s: &Sampler| {
            let mut s = *s;
            let pairs: Vec<_> = (0..STRATIFIED).map(|_| s.next_2d()).collect();
            (pairs, [s.next_1d(), s.next_1d()])
        };
        assert_eq!(draw(&plain), draw(&plain.moved(&moves)));
        let mut sums = [glam::Vec2::ZERO; 2];
        let n = 20_000;
        for _ in 0..n {
            moves = moves.step(&mut random);
            let (pairs, late) = draw(&plain.moved(&moves));
            assert_eq!(late, draw(&plain).1);
            let all_in = |v: &glam::Vec2| v.min_element() >= 0.0 && v.max_element() < 1.0;
            assert!(pairs.iter().all(all_in));
            sums[0] += pairs.iter().sum::<glam::Vec2>() / STRATIFIED as f32;
            sums[1] += pairs.iter().map(|v| *v * *v).sum::<glam::Vec2>() / STRATIFIED as f32;
        }
        // The mean and the mean square of even numbers; steps in a row are much alike.
        let [first, second] = sums.map(|s| s / n as f32);
        assert!((first - 0.5).abs().max_element() < 0.02 && (second - 1.0 / 3.0).abs().max_element() < 0.02);
    }

    #[test]
    fn a_stream_is_a_pure_function_of_its_address() {
        let draw = |seed, d, p, i| {
            let mut s = Sampler::new(seed, d, p, i);
            (0..40).map(|_| s.next_1d()).collect::<Vec<_>>()
        };
        let a = draw(1, Domain::Camera, 2, 3);
        assert_eq!(a, draw(1, Domain::Camera, 2, 3));
        for other in [
            draw(2, Domain::Camera, 2, 3),
            draw(1, Domain::Light, 2, 3),
            draw(1, Domain::Camera, 3, 3),
            draw(1, Domain::Camera, 2, 4),
        ] {
            assert!(a.iter().zip(&other).filter(|(x, y)| x == y).count() < 3);
        }
    }
}

//! Random numbers: xoshiro256++ seeded by splitmix64 (Blackman & Vigna, "Scrambled linear pseudorandom number generators",
//! TOMS 2021).

use std::f64::consts::TAU;

/// A generator of pseudo-random numbers with a fixed algorithm.
#[derive(Clone, Debug)]
pub struct Random([u64; 4]);

impl Random {
    /// The stream of `seed`.
    pub fn new(seed: u64) -> Self {
        let mut state = seed;
        Self([(); 4].map(|()| {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (state ^ state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ z >> 31
        }))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        let s = &mut self.0;
        let result = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = s[3].rotate_left(45);
        result
    }

    /// A multiple of 2^-53 in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (f64::EPSILON / 2.0)
    }

    /// A number in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// An integer in 0..n, by the multiply-and-shift method (a bias below n / 2^64).
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.bits()) * n as u128) >> 64) as usize
    }

    /// A number of the standard normal distribution (Box & Muller).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.unit())).sqrt();
        radius * libm::cos(TAU * self.unit())
    }

    /// A uniformly random permutation (Fisher & Yates).
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }
}

/// A random point of the unit ball of D dimensions.
pub fn in_ball<const D: usize>(random: &mut Random) -> [f64; D] {
    loop {
        let mut u = [0.0; D];
        u.iter_mut().for_each(|x| *x = random.between(-1.0, 1.0));
        if u.iter().map(|x| x * x).sum::<f64>() <= 1.0 {
            return u;
        }
    }
}

/// Each point moved at random inside of a ball around it.
pub fn moved<const D: usize>(points: &[[f64; D]], radius: f64, random: &mut Random) -> Vec<[f64; D]> {
    let shift = |p: &[f64; D]| {
        let (mut q, u) = (*p, in_ball::<D>(random));
        q.iter_mut().zip(u).for_each(|(x, u)| *x += radius * u);
        q
    };
    points.iter().map(shift).collect()
}

#[cfg(test)]
mod tests {
    use super::Random;

    #[test]
    fn the_stream_never_changes() {
        let mut random = Random::new(1);
        let first = [(); 3].map(|()| random.bits());
        assert_eq!(first, [0xcfc5_d07f_6f03_c29b, 0xbf42_4132_963f_e08d, 0x19a3_7d57_57aa_f520]);
    }
}

//! Engines that are wrong on purpose wherever the number 13 is in the list: what supervision is tested with.

use std::hint::black_box;

use delone_generators::Random;

use crate::attack::{Attack, Judgement};

const BAD: usize = 13;

fn numbers() -> Vec<usize> {
    (0..20).collect()
}

macro_rules! broken {
    ($($(#[$about:meta])* $name:ident: $wrong:expr;)+) => { $(
        $(#[$about])*
        pub(crate) struct $name;

        impl Attack for $name {
            type Item = usize;

            fn make(_: &mut Random) -> Vec<usize> {
                numbers()
            }

            fn judge(items: &[usize], _: u64) -> Judgement {
                if items.contains(&BAD) { $wrong } else { Ok(()) }
            }
        }
    )+ };
}

broken! {
    /// Answers wrongly.
    Answer: Err("13 is wrong".to_owned());
    /// Panics.
    Panic: panic!("13 is unlucky");
    /// Does not end.
    Hang: loop {
        std::thread::yield_now();
    };
    /// Takes all memory there is.
    Memory: {
        let mut all = Vec::new();
        loop {
            all.push(black_box(vec![1_u8; 1 << 24]));
        }
    };
    /// Recurses without end.
    Stack: {
        black_box(deeper(1));
        Ok(())
    };
    /// Has nothing wrong.
    Sound: Ok(());
}

fn deeper(depth: u64) -> u64 {
    let here = black_box([depth; 64]);
    if black_box(depth) == 0 { 0 } else { deeper(depth + 1) + here[7] }
}

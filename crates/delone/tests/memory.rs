//! Memory is asked for once: what instance after instance needs is there after the first.

use delone::{HintOrder, Hints2, Hints3};
use delone_generators::{Kind, Kind3, Random};

fn moved<const D: usize>(points: &[[f64; D]], by: f64) -> Vec<[f64; D]> {
    let mut random = Random::new(3);
    points.iter().map(|p| p.map(|x| x + by * random.between(-1.0, 1.0))).collect()
}

#[test]
fn instances_take_the_memory_of_the_first() {
    let (plane, space) = (Kind::Disks.points(5_000, 1), Kind3::Balls.points(2_000, 1));
    let mut hints = Hints2::from_points(&plane, HintOrder::default()).expect("finite");
    let mut in_space = Hints3::from_points(&space, HintOrder::default()).expect("finite");
    for round in 0..4 {
        let (p, q) = (moved(&plane, f64::from(round) / 4.0), moved(&space, f64::from(round) / 4.0));
        let taken = [
            allocation_counter::measure(|| assert!(hints.triangulate(&p).is_ok())),
            allocation_counter::measure(|| assert!(hints.follow(&p).is_ok())),
            allocation_counter::measure(|| assert!(in_space.triangulate(&q).is_ok())),
            allocation_counter::measure(|| assert!(in_space.follow(&q).is_ok())),
        ];
        let [plane, followed, space, followed_in_space] = taken.map(|info| info.bytes_total);
        // Counting works at all.
        assert!(round > 0 || (plane > 500_000 && space > 500_000), "{taken:?}");
        assert!(round == 0 || (plane == 0 && space < 100), "{taken:?}");
        assert!(followed == 0 && followed_in_space < 100, "{taken:?}");
    }
}

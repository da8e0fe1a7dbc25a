use delone::plane::*;
use delone_oracle::generate::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let k = Kind::named(&args[1]).unwrap(); let n: usize = args[2].parse().unwrap(); let reps: usize = args[3].parse().unwrap();
    let p = k.points(n, 1);
    let mut v = vec![];
    for _ in 0..reps { let t = std::time::Instant::now(); let d = Delaunay2::from_points(&p); let e = t.elapsed().as_nanos() as f64 / n as f64; v.push(e); std::hint::black_box(&d.mesh); }
    v.sort_by(f64::total_cmp);
    println!("{} min {:.0} med {:.0}", args[1], v[0], v[v.len()/2]);
}

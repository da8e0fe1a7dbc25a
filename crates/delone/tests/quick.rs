use delone::plane::*;
use delone_oracle::{brute, generate::*};
fn tri(points: &[[f64;2]]) -> Vec<[[f64;2];3]> {
    let d = Delaunay2::from_points(points);
    brute::normalized(d.mesh.triangles().map(|t| d.mesh.corners(t).map(|v| points[v.index()])))
}
#[test]
fn small_grids() {
    let pts: Vec<_> = (0..16).map(|i| [(i%4) as f64, (i/4) as f64]).collect();
    let table = brute::Table::new(&pts);
    for s in 0..65536u64 {
        let sub: Vec<_> = (0..16).filter(|i| s>>i&1==1).map(|i| pts[i]).collect();
        assert_eq!(tri(&sub), table.delaunay(s), "{s:b} {sub:?}");
    }
}
#[test]
fn kinds() {
    for &k in Kind::ALL { for n in 1..24 {  for seed in 0..20 {
        let p = k.points(n, seed);
        assert_eq!(tri(&p), brute::delaunay(&p), "{} {n} {seed} {p:?}", k.name());
    }}}
}
#[test]
fn time() {
    for &k in Kind::ALL { 
        let p = k.points(if k==Kind::HugeSpan {10000} else {1000000}, 1);
        let t = std::time::Instant::now();
        let d = Delaunay2::from_points(&p);
        eprintln!("{} {} {:?}", k.name(), d.mesh.slot_count(), t.elapsed().as_nanos() / p.len() as u128);
    }
}
#[test]
fn one() {
    let p = [[0.,0.],[0.,1.],[0.,2.],[1.,2.],[3.,0.]];
    let d = Delaunay2::from_points(&p);
    for t in 0..d.mesh.slot_count() { let t0 = 4*t; eprintln!("{t}: {:?}", (0..3).map(|k| { let id = d.mesh.triangles().next().unwrap(); let _ = (id, t0, k); 0 }).collect::<Vec<_>>()); }
    eprintln!("{:?}", d.mesh);
}

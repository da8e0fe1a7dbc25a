fn main() {
    use std::time::Instant;
    use delone_oracle::generate::Kind;
    unsafe extern "C" { fn cgal_plain(xy: *const f64, n: usize) -> usize; fn cgal_indexed(xy: *const f64, n: usize, t: *mut u32) -> usize; }
    for name in ["uniform","clusters","grid","circle","ellipse","ellipse2","parabola","lognormal","outliers"] {
        let n = 1_000_000;
        let p = Kind::named(name).unwrap().points(n, 1);
        let mut best = [f64::MAX; 6];
        for _ in 0..2 {
            let mut time = |i: usize, f: &mut dyn FnMut()| { let t = Instant::now(); f(); best[i] = best[i].min(t.elapsed().as_nanos() as f64 / n as f64); };
            time(0, &mut || { std::hint::black_box(delone::plane::Delaunay2::from_points(&p)); });
            time(1, &mut || unsafe { cgal_plain(p.as_ptr().cast(), n); });
            let mut t = vec![0u32; 6*n];
            time(2, &mut || unsafe { cgal_indexed(p.as_ptr().cast(), n, t.as_mut_ptr()); });
            if name != "ellipse" {
            time(3, &mut || { let q: Vec<_> = p.iter().map(|p| delaunator::Point{x:p[0],y:p[1]}).collect(); std::hint::black_box(delaunator::triangulate(&q)); });
            time(4, &mut || { use spade::Triangulation; let q: Vec<_> = p.iter().map(|p| spade::Point2::new(p[0],p[1])).collect(); std::hint::black_box(spade::DelaunayTriangulation::<spade::Point2<f64>>::bulk_load(q).unwrap()); });
            }
        }
        println!("{name:10} delone {:.0} cgal {:.0} indexed {:.0} delaunator {:.0} spade {:.0}", best[0], best[1], best[2], best[3], best[4]);
    }
}

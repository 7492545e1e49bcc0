//! Quick timing.
use isophote::lanes::{Instructions, Precision};
use isophote::map::Quantity;
use isophote::prepare::PreparedScene;
use isophote::render::*;
use isophote::scene::Scene;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let (w, h): (u32, u32) = (a[2].parse().unwrap(), a[3].parse().unwrap());
    let mut src = Scene::from_file(a[1].as_ref()).unwrap().source().clone();
    src.camera.get_or_insert_default().resolution = Some([w.into(), h.into()]);
    let scene = PreparedScene::new(&Scene::try_from(src).unwrap());
    let px = f64::from(w) * f64::from(h);
    let lights = scene.scene().lights().len() as f64;
    for threads in [1, 2] {
        for p in [Precision::Single, Precision::Double] {
            for i in Instructions::all() {
                if let Some(f) = a.get(5) { if !f.split(',').any(|f| f == i.name()) { continue; } }
                if let Some(f) = a.get(6) { if *f != format!("{p:?}") { continue; } }
                if threads == 2 && i.name() != "avx512" { continue; }
                let r = Lanes::new(p, std::num::NonZeroUsize::new(threads)).with_instructions(i);
                let s = RenderSettings { quantities: vec![Quantity::Brightness], ..Default::default() };
                let mut old = Some(r.render(&scene, &s).unwrap());
                let mut u: Vec<f64> = (0..a[4].parse().unwrap()).map(|_| { let s0 = std::time::Instant::now(); let m = r.render_again(&scene, &s, old.take().unwrap()).unwrap(); let e = s0.elapsed().as_secs_f64(); old = Some(m); e }).collect();
                u.sort_by(f64::total_cmp);
                let mut t: Vec<f64> = (0..a[4].parse().unwrap()).map(|_| { let s0 = std::time::Instant::now(); let m = r.render(&scene, &s).unwrap(); let e = s0.elapsed().as_secs_f64(); std::hint::black_box(&m); e }).collect();
                t.sort_by(f64::total_cmp);
                let m = r.render(&scene, &s).unwrap();
                let vis = m.mask().visible() as f64;
                println!("{threads} {p:?} {}: again min {:.1} median {:.1} us, fresh min {:.1} us, median {:.1} us; {:.3} ns/px {:.3} ns/visible/light", i.name(), u[0]*1e6, u[u.len()/2]*1e6, t[0]*1e6, t[t.len()/2]*1e6, u[0]*1e9/px, u[0]*1e9/vis/lights);
            }
        }
    }
}

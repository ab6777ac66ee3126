use super::*;

/// Node distance [m].
const H: f64 = 0.01;

/// A floor and an incline of 40° that meet this far along the lattice [node
/// distances]; base friction 0.2 and 0.6.
fn sloped(foot: f64) -> PlanarBed {
    let inclination = 40f64.to_radians();
    PlanarBed::floor(0.2).with_incline(inclination, inclination.sin() * foot * H, 0.6)
}

fn surfaces(foot: f64) -> Vec<Surface> {
    let lattice = Lattice {
        origin: Vec3::zeros(),
        spacing: Vec3::repeat(H),
    };
    let bed = sloped(foot);
    let of_column = |along: i32| {
        let plane = usize::from(f64::from(along) < foot);
        bed.surface_at(plane, Way::Vertical, along, &lattice)
    };
    (0..=20).map(of_column).collect()
}

// The fall of the columns' slopes, each over one node distance, is that of the incline, and
// about the same place: moments 0 and 1 of the break, for any phase.
#[test]
fn the_break_lies_where_it_is() {
    let slope = -40f64.to_radians().tan();
    for foot in [10.0, 10.1, 10.25, 10.5, 10.8] {
        let slopes = surfaces(foot).into_iter().map(|surface| {
            assert!((surface.normal.norm() - 1.0).abs() < 1e-15);
            -surface.normal.x / surface.normal.z
        });
        let (mut fall, mut moment) = (0.0, 0.0);
        for (along, slope) in slopes.enumerate() {
            fall += slope;
            moment += slope * along as f64;
        }
        // From half a node distance before the first column to the foot.
        let length = foot + 0.5;
        assert!((fall - slope * length).abs() < 1e-12, "{foot}: {fall}");
        // The spread's variance is that of the kernel, 1/4, and of a column's width,
        // 1/12: it adds half of itself to the moment of the incline.
        let expected = slope * (0.5 * (foot * foot - 0.25) + 0.5 * (0.25 + 1.0 / 12.0));
        assert!((moment - expected).abs() < 1e-12, "{foot}: {moment}");
    }
}

#[test]
fn away_from_the_break_the_bed_is_the_plane() {
    let surfaces = surfaces(10.3);
    let bed = sloped(10.3);
    for (along, plane) in [(0, 1), (8, 1), (12, 0), (20, 0)] {
        let expected = bed.planes[plane];
        assert!((surfaces[along].normal - expected.normal).norm() < 1e-14);
        assert!((surfaces[along].friction - expected.flow_friction).abs() < 1e-14);
    }
    // Between them friction and slope lie between those of both.
    let middle = surfaces[10];
    assert!(middle.friction > 0.2 && middle.friction < 0.6);
    assert!(middle.normal.x > 0.0 && middle.normal.x < bed.planes[1].normal.x);
}

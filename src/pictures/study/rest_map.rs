//! Map of where a body comes to rest.

use super::frame::{Frame, head, length, line, range};
use crate::pictures::canvas::{
    Area, FAINT_INK, INK, PictureError, paint, px, text, width as stroke,
};
use crate::pictures::format::{plain, significant};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use scree_solver::scenario::Scenario;
use scree_studies::answers::{Polygon, Region, RestDistribution};
use std::ops::Range;

/// Width of the picture, and of what is beside its field [px].
const WIDTH: f64 = 840.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 20.0;
/// Above and below the field [px].
const HEADER: f64 = 84.0;
const FOOTER: f64 = 46.0;
/// Least and most height of the field [px].
const HEIGHTS: (f64, f64) = (120.0, 640.0);
/// Colours of the regions, from the most probable one outwards.
const REGIONS: [RGBColor; 5] = [
    RGBColor(8, 81, 156),
    RGBColor(66, 133, 190),
    RGBColor(126, 178, 216),
    RGBColor(183, 212, 234),
    RGBColor(222, 235, 247),
];
/// Colour of the members' places.
const PLACE: RGBColor = RGBColor(60, 40, 20);
/// Colour of the place where the body stands at the start.
const START: RGBColor = RGBColor(200, 16, 16);

/// Regions that hold a body at rest with given probabilities, the members' resting places, places
/// at which many rest (a circle with their share), and where the body stands at the start (a
/// cross), seen from above on equal scales: x downstream, y across [m] in a channel; x east, y north
/// of the height map's corner [m] on a terrain, where the start is only known with the map.
///
/// # Errors
/// The drawing library fails.
pub fn rest_map(
    name: &str,
    scenario: Option<&Scenario>,
    body: usize,
    (rest, places): (&RestDistribution, &[[f64; 2]]),
) -> Result<String, PictureError> {
    let start = scenario.filter(|scenario| body < scenario.bodies.len());
    let has_ground = |scenario: &&Scenario| {
        let terrain = scenario.terrain();
        terrain.is_none_or(|terrain| terrain.maps.get(&terrain.height_map).is_some())
    };
    let start = start.filter(has_ground).map(|scenario| {
        let position = scenario.initial_pose(body).position;
        [position.x, position.y]
    });
    let frame = frame(scenario, rest, (places, start));
    paint((WIDTH, HEADER + frame.height + FOOTER), |sheet| {
        head(sheet, name, &subtitle(rest, body, places.len()))?;
        draw_legend(sheet, &rest.regions)?;
        frame.draw(sheet, (10, 6))?;
        let mut largest_first: Vec<&Region> = rest.regions.iter().collect();
        largest_first.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        for region in &largest_first {
            let color = color_of(region, &rest.regions);
            for polygon in &region.polygons {
                draw_polygon(sheet, &frame, polygon, color)?;
            }
        }
        if let Some(scenario) = scenario {
            draw_channel(sheet, &frame, scenario)?;
        }
        for place in places.iter().filter(|[x, y]| frame.shows(*x, *y)) {
            let dot = Circle::new(frame.device(*place), stroke(1.3), PLACE.mix(0.6).filled());
            sheet.draw(&dot)?;
        }
        draw_atoms(sheet, &frame, rest)?;
        if let Some(start) = start {
            draw_cross(sheet, frame.at(start[0], start[1]))?;
        }
        frame.numbers_below(sheet, 10)?;
        frame.numbers_left(sheet, 6)?;
        draw_axis_titles(sheet, &frame, axis_titles(scenario))
    })
}

fn subtitle(rest: &RestDistribution, body: usize, places: usize) -> String {
    let mut line = format!("Where body {body} comes to rest: {places} members");
    if rest.moving > 0 {
        line.push_str(&format!(", {} still moving", rest.moving));
    }
    line.push_str("; + at the start");
    line
}

/// The field: all places and regions, and the whole width of the channel if that is not much
/// wider.
fn frame(
    scenario: Option<&Scenario>,
    rest: &RestDistribution,
    (places, start): (&[[f64; 2]], Option<[f64; 2]>),
) -> Frame {
    let polygons = rest.regions.iter().flat_map(|region| &region.polygons);
    let corners = polygons.flat_map(|polygon| &polygon.outer_m);
    let all: Vec<[f64; 2]> = corners.chain(places).copied().chain(start).collect();
    let x = range(all.iter().map(|place| place[0]), 0.08);
    let mut y = range(all.iter().map(|place| place[1]), 0.08);
    if let Some(channel) = scenario.and_then(Scenario::channel) {
        let half = 0.52 * channel.width_m;
        y = y.start.min(-half)..y.end.max(half);
    }
    let width = WIDTH - LEFT - RIGHT;
    let (x, y, height) = with_equal_scales(x, y, width);
    Frame {
        left: LEFT,
        top: HEADER,
        width,
        height,
        x,
        y,
    }
}

/// Ranges, one of them wider than asked for if need be, and the height of the field [px].
fn with_equal_scales(x: Range<f64>, y: Range<f64>, width: f64) -> (Range<f64>, Range<f64>, f64) {
    let widened = |range: Range<f64>, to: f64| {
        let by = 0.5 * (to - length(&range)).max(0.0);
        range.start - by..range.end + by
    };
    let height = (width * length(&y) / length(&x)).clamp(HEIGHTS.0, HEIGHTS.1);
    let scale = (length(&x) / width).max(length(&y) / height);
    (
        widened(x, scale * width),
        widened(y, scale * height),
        height,
    )
}

/// Colour of a region: the darkest for the lowest probability.
fn color_of(region: &Region, all: &[Region]) -> RGBColor {
    let inside = all
        .iter()
        .filter(|other| other.probability < region.probability)
        .count();
    REGIONS[inside.min(REGIONS.len() - 1)]
}

fn draw_polygon(
    sheet: &Area<'_>,
    frame: &Frame,
    polygon: &Polygon,
    color: RGBColor,
) -> Result<(), PictureError> {
    let device = |ring: &[[f64; 2]]| ring.iter().map(|corner| frame.device(*corner)).collect();
    let ring: Vec<(i32, i32)> = device(&polygon.outer_m);
    sheet.draw(&plotters::element::Polygon::new(ring, color.filled()))?;
    for hole in &polygon.holes_m {
        let ring: Vec<(i32, i32)> = device(hole);
        sheet.draw(&plotters::element::Polygon::new(ring, WHITE.filled()))?;
    }
    Ok(())
}

fn draw_legend(sheet: &Area<'_>, regions: &[Region]) -> Result<(), PictureError> {
    let mut shown: Vec<&Region> = regions.iter().collect();
    shown.sort_by(|a, b| a.probability.total_cmp(&b.probability));
    let mut left = 16.0;
    for region in shown {
        let box_px = [(px(left), px(58.0)), (px(left + 14.0), px(70.0))];
        sheet.draw(&Rectangle::new(box_px, color_of(region, regions).filled()))?;
        let label = format!(
            "{} %: {} ± {} m²",
            plain(100.0 * region.probability),
            significant(region.area_m2, 2),
            significant(region.area_standard_error_m2, 1)
        );
        let style = text(11.5, &INK).pos(Pos::new(HPos::Left, VPos::Center));
        sheet.draw_text(&label, &style, (px(left + 19.0), px(64.0)))?;
        left += 36.0 + 6.4 * label.chars().count() as f64;
    }
    Ok(())
}

/// Side walls, and the foot of the incline (dashed).
fn draw_channel(sheet: &Area<'_>, frame: &Frame, scenario: &Scenario) -> Result<(), PictureError> {
    let Some(channel) = scenario.channel() else {
        return Ok(());
    };
    let half = 0.5 * channel.width_m;
    let right = channel.runout_length_m.min(frame.x.end);
    let left = (-channel.incline_length_m).max(frame.x.start);
    for y in [-half, half] {
        let ends = (frame.at(left, y), frame.at(right, y));
        line(sheet, ends, (&FAINT_INK, 1.2))?;
    }
    if channel.inclination_deg > 0.0 && frame.x.contains(&0.0) {
        let foot = [[0.0, -half], [0.0, half]].map(|place| frame.device(place));
        let style = INK.stroke_width(stroke(1.0));
        sheet.draw(&DashedPathElement::new(foot, px(4.0), px(3.0), style))?;
    }
    Ok(())
}

fn draw_atoms(
    sheet: &Area<'_>,
    frame: &Frame,
    rest: &RestDistribution,
) -> Result<(), PictureError> {
    for atom in &rest.atoms {
        let at = frame.device(atom.place_m);
        let ring = PLACE.stroke_width(stroke(1.6));
        sheet.draw(&Circle::new(at, stroke(6.0), ring))?;
        let label = format!("{} %", plain(100.0 * atom.share));
        let style = text(11.0, &INK).pos(Pos::new(HPos::Left, VPos::Bottom));
        sheet.draw_text(&label, &style, (at.0 + px(7.0), at.1 - px(5.0)))?;
    }
    Ok(())
}

fn draw_cross(sheet: &Area<'_>, (x, y): (f64, f64)) -> Result<(), PictureError> {
    let arm = 6.0;
    line(sheet, ((x - arm, y), (x + arm, y)), (&START, 2.0))?;
    line(sheet, ((x, y - arm), (x, y + arm)), (&START, 2.0))
}

/// Names of the axes by the ground.
fn axis_titles(scenario: Option<&Scenario>) -> [&'static str; 2] {
    match scenario.and_then(Scenario::terrain) {
        None => ["x downstream [m]", "y across [m]"],
        Some(_) => [
            "x east on the height map [m]",
            "y north on the height map [m]",
        ],
    }
}

fn draw_axis_titles(
    sheet: &Area<'_>,
    frame: &Frame,
    [along, across]: [&str; 2],
) -> Result<(), PictureError> {
    let below = text(12.0, &INK).pos(Pos::new(HPos::Center, VPos::Bottom));
    let middle = frame.left + 0.5 * frame.width;
    let bottom = HEADER + frame.height + FOOTER - 6.0;
    sheet.draw_text(along, &below, (px(middle), px(bottom)))?;
    let upright = text(12.0, &INK)
        .transform(FontTransform::Rotate270)
        .pos(Pos::new(HPos::Center, VPos::Top));
    let middle = frame.top + 0.5 * frame.height;
    sheet.draw_text(across, &upright, (px(8.0), px(middle)))?;
    Ok(())
}

//! Shapes and texts of an SVG document, in the order in which they are drawn, and which of them meet.

use roxmltree::{Document, Node};

type Point = (f64, f64);

/// A text with the extent of its digits or capitals [px of the drawing].
#[derive(Debug, Clone)]
pub(super) struct Text {
    pub(super) text: String,
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

/// An element of the drawing.
#[derive(Debug)]
enum Element {
    Line(Vec<Point>),
    /// Opaque, with its colour.
    Disc(Point, f64, String),
    /// Convex and opaque, with its colour.
    Polygon(Vec<Point>, String),
    Text(Text),
}

/// A drawing.
pub(super) struct Drawn(Vec<Element>);

impl Drawn {
    pub(super) fn of(svg: &str) -> Self {
        let document = Document::parse(svg).expect("well-formed XML");
        Self(document.descendants().filter_map(element).collect())
    }

    /// All texts with what spoils them: a line through it, a shape that covers part of it, or
    /// another text. What an opaque shape below the text hides spoils nothing, if `may_hide`.
    pub(super) fn spoilt(&self, may_hide: bool) -> Vec<String> {
        let mut spoilt = Vec::new();
        for (index, text) in self.texts() {
            let hidden = self.ground(index, text).filter(|_| may_hide);
            for (other, element) in self.0.iter().enumerate() {
                let is_hidden = hidden.is_some_and(|ground| other <= ground);
                if other != index && !is_hidden && element.spoils(text) {
                    spoilt.push(format!("{:?} by {element:?}", text.text));
                }
            }
        }
        spoilt
    }

    /// Every number on a coloured ground, with the colour, in the order of drawing.
    pub(super) fn numbers(&self) -> Vec<(usize, String)> {
        let number = |(index, text): (usize, &Text)| {
            let number = text.text.parse().ok()?;
            let (Element::Disc(_, _, color) | Element::Polygon(_, color)) =
                &self.0[self.ground(index, text)?]
            else {
                return None;
            };
            Some((number, color.clone()))
        };
        self.texts().filter_map(number).collect()
    }

    fn texts(&self) -> impl Iterator<Item = (usize, &Text)> {
        self.0.iter().enumerate().filter_map(|(index, element)| {
            let Element::Text(text) = element else {
                return None;
            };
            Some((index, text))
        })
    }

    /// The shape on which a text stands as a whole.
    fn ground(&self, index: usize, text: &Text) -> Option<usize> {
        let mut below = (0..index).rev();
        below.find(|below| self.0[*below].holds(text))
    }
}

impl Element {
    fn holds(&self, text: &Text) -> bool {
        match self {
            Self::Line(_) | Self::Text(_) => false,
            shape => text.points().into_iter().all(|at| shape.covers(at)),
        }
    }

    fn spoils(&self, text: &Text) -> bool {
        match self {
            Self::Text(other) => {
                let apart = other.right <= text.left
                    || text.right <= other.left
                    || other.bottom <= text.top
                    || text.bottom <= other.top;
                !apart
            }
            Self::Line(points) => points
                .windows(2)
                .any(|ends| text.is_crossed(ends[0], ends[1])),
            shape => {
                let covered = text
                    .points()
                    .into_iter()
                    .filter(|at| shape.covers(*at))
                    .count();
                covered > 0 && covered < text.points().len()
            }
        }
    }

    fn covers(&self, at: Point) -> bool {
        match self {
            Self::Disc(centre, radius, _) => (at.0 - centre.0).hypot(at.1 - centre.1) <= *radius,
            Self::Polygon(corners, _) => {
                let turns = || {
                    (0..corners.len()).map(|k| {
                        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
                        (b.0 - a.0) * (at.1 - a.1) - (b.1 - a.1) * (at.0 - a.0)
                    })
                };
                turns().all(|turn| turn <= 0.0) || turns().all(|turn| turn >= 0.0)
            }
            Self::Line(_) | Self::Text(_) => false,
        }
    }
}

impl Text {
    fn new(node: Node<'_, '_>) -> Self {
        let text = node.text().unwrap_or_default().trim().to_owned();
        let (x, y, size) = (
            number(node, "x"),
            number(node, "y"),
            number(node, "font-size"),
        );
        let length = 0.55 * size * text.chars().count() as f64;
        let from = match node.attribute("text-anchor") {
            Some("middle") => -length / 2.0,
            Some("end") => -length,
            _ => 0.0,
        };
        let height = 0.7 * size;
        let top = match node.attribute("dy") {
            Some("0.76em") => 0.0,
            // Half of a small letter's height, 0.27 of the size, is below.
            Some("0.5ex") => 0.27 * size - height,
            _ => -height,
        };
        // Turned texts are turned by 270° around their point: upwards is to the left.
        let turned = node.has_attribute("transform");
        let (left, top, width, height) = if turned {
            (x + top, y - from - length, height, length)
        } else {
            (x + from, y + top, length, height)
        };
        Self {
            text,
            left,
            top,
            right: left + width,
            bottom: top + height,
        }
    }

    /// Corners, middles of the sides, and centre.
    fn points(&self) -> Vec<Point> {
        let across = [self.left, (self.left + self.right) / 2.0, self.right];
        let down = [self.top, (self.top + self.bottom) / 2.0, self.bottom];
        across.iter().flat_map(|x| down.map(|y| (*x, y))).collect()
    }

    /// True if a segment passes through the extent (Liang and Barsky's clipping).
    fn is_crossed(&self, from: Point, to: Point) -> bool {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let sides = [
            (-x, from.0 - self.left),
            (x, self.right - from.0),
            (-y, from.1 - self.top),
            (y, self.bottom - from.1),
        ];
        let (mut entry, mut exit) = (0.0_f64, 1.0_f64);
        for (towards, distance) in sides {
            if towards == 0.0 {
                if distance <= 0.0 {
                    return false;
                }
            } else if towards < 0.0 {
                entry = entry.max(distance / towards);
            } else {
                exit = exit.min(distance / towards);
            }
        }
        entry < exit
    }
}

fn element(node: Node<'_, '_>) -> Option<Element> {
    // Lines of the grid are part of the ground.
    if node.attribute("stroke") == Some("#DEE1E5") {
        return None;
    }
    let fill = node.attribute("fill").unwrap_or("none").to_owned();
    match node.tag_name().name() {
        "text" => Some(Element::Text(Text::new(node))),
        "line" => Some(Element::Line(vec![
            (number(node, "x1"), number(node, "y1")),
            (number(node, "x2"), number(node, "y2")),
        ])),
        "polyline" => Some(Element::Line(points(node))),
        "polygon" => Some(Element::Polygon(points(node), fill)),
        "circle" if fill != "none" => {
            let centre = (number(node, "cx"), number(node, "cy"));
            Some(Element::Disc(centre, number(node, "r"), fill))
        }
        _ => None,
    }
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    let value = node.attribute(name).and_then(|value| value.parse().ok());
    value.unwrap_or_else(|| panic!("{name} of {node:?}"))
}

fn points(node: Node<'_, '_>) -> Vec<Point> {
    let points = node.attribute("points").expect("points").split_whitespace();
    let parsed = points.filter_map(|pair| {
        let (x, y) = pair.split_once(',')?;
        Some((x.parse().ok()?, y.parse().ok()?))
    });
    parsed.collect()
}

#[test]
fn a_crossed_a_covered_and_a_doubled_text_are_found() {
    let text = r#"<text x="100" y="100" dy="0.5ex" text-anchor="middle" font-size="10">abc</text>"#;
    let spoilt = |before: &str, after: &str, may_hide| {
        Drawn::of(&format!("<svg>{before}{text}{after}</svg>")).spoilt(may_hide)
    };
    let line = r##"<polyline fill="none" stroke="#000000" points="0,101 200,99 "/>"##;
    let far = r##"<line stroke="#000000" x1="0" y1="110" x2="200" y2="110"/>"##;
    let disc = r##"<circle cx="100" cy="100" r="20" fill="#FF0000"/>"##;
    let half = r##"<polygon points="100,0 200,0 200,200 100,200 " fill="#FF0000"/>"##;
    assert_eq!(spoilt(far, "", false).len(), 0);
    assert_eq!(spoilt(line, "", false).len(), 1);
    assert_eq!(spoilt(&format!("{line}{disc}"), "", true).len(), 0);
    assert_eq!(spoilt(&format!("{line}{disc}"), "", false).len(), 1);
    assert_eq!(spoilt(&format!("{disc}{line}"), "", true).len(), 1);
    assert_eq!(spoilt(disc, half, true).len(), 1);
    assert_eq!(spoilt("", text, true).len(), 2);
}

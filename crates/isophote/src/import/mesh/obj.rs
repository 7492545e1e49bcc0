//! Wavefront OBJ: vertices, normals and polygons. Polygons become fans of triangles around their first corner.
//!
//! Names of objects and groups, smoothing groups, texture coordinates, vertex colours and the material library do not affect
//! the shape and are skipped; points and lines have no surface; curved surfaces are rejected. The normals used are those
//! that the faces refer to (`f 1//1 …`).

use crate::message;
use crate::text::Message;
use memchr::memchr;

use super::{MeshBuilder, NO_NORMALS, TriangleMesh};
use crate::import::{
    Fault, FilePosition, FileProblem,
    text::{finite_number, integer, lines, shown, words},
};

/// The mesh of an OBJ file. Faces may refer to vertices of later lines, so they are processed last.
pub(in crate::import) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let mut vertices = Vertices::default();
    statements(bytes, |keyword, words| vertices.read(keyword, words))?;
    let mut faces = Faces::new(&vertices);
    statements(bytes, |keyword, words| faces.read(keyword, words))?;
    faces.builder.finish()
}

/// Calls `read` with the keyword and the rest of each statement, with comments removed and continued lines joined.
fn statements(bytes: &[u8], mut read: impl FnMut(&[u8], &[u8]) -> Result<(), FileProblem>) -> Result<(), Fault> {
    let mut continued: Vec<u8> = Vec::new();
    for (number, line) in lines(bytes) {
        let line = memchr(b'#', line).map_or(line, |comment| &line[..comment]);
        if let Some(part) = line.strip_suffix(b"\\") {
            continued.extend_from_slice(part);
            continued.push(b' ');
            continue;
        }
        let whole = std::mem::take(&mut continued);
        let whole = if whole.is_empty() { line } else { &[&whole, line].concat() };
        let whole = whole.trim_ascii();
        let (keyword, rest) = whole.split_at(whole.iter().position(u8::is_ascii_whitespace).unwrap_or(whole.len()));
        if !keyword.is_empty() {
            read(keyword, rest).map_err(|problem| problem.at(FilePosition::Line(number)))?;
        }
    }
    if continued.is_empty() {
        return Ok(());
    }
    Err(FileProblem::Missing {
        what: message!("the line after the last ‘{mark}’", mark = '\\'),
        needed: message!("it is continued there"),
    }
    .at(FilePosition::Whole))
}

#[derive(Debug, Default)]
struct Vertices {
    positions: Vec<[f64; 3]>,
    textures: usize,
    normals: Vec<[f64; 3]>,
}

impl Vertices {
    fn read(&mut self, keyword: &[u8], rest: &[u8]) -> Result<(), FileProblem> {
        match keyword {
            b"v" => {
                // A weight or a colour, or both, may follow.
                self.positions.push(three(rest, || message!("the vertex"), &[3, 4, 6, 7])?);
            }
            b"vn" => self.normals.push(three(rest, || message!("the normal"), &[3])?),
            b"vt" => self.textures += 1,
            b"f" | b"fo" | b"usemtl" | b"o" | b"g" | b"s" | b"mg" | b"mtllib" | b"p" | b"l" | b"lod" | b"bevel"
            | b"c_interp" | b"d_interp" | b"shadow_obj" | b"trace_obj" | b"usemap" | b"maplib" => {}
            b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim"
            | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"ctech" | b"stech" | b"call" | b"csh" => {
                let what = message!("‘{keyword}’ (curves, curved surfaces, other files)", keyword = shown(keyword));
                return Err(FileProblem::Unsupported { what, instead: message!("export polygons") });
            }
            _ => return Err(unknown(keyword)),
        }
        Ok(())
    }
}

fn unknown(keyword: &[u8]) -> FileProblem {
    FileProblem::Unexpected {
        what: message!("the line's first word"),
        found: shown(keyword),
        allowed: message!("the keywords of OBJ: v, vn, vt, f, usemtl, o, g, s, mtllib and others"),
    }
}

fn three(rest: &[u8], what: fn() -> Message, allowed: &[usize]) -> Result<[f64; 3], FileProblem> {
    let mut vector = [0.0; 3];
    let mut parts = words(rest);
    let mut found = 0;
    for (component, field) in vector.iter_mut().zip(["x", "y", "z"]) {
        let Some(word) = parts.next() else { break };
        *component = finite_number(word, field)?;
        found += 1;
    }
    found += parts.count();
    if allowed.contains(&found) {
        return Ok(vector);
    }
    let counts: Vec<String> = allowed.iter().map(usize::to_string).collect();
    let allowed = message!("allowed are {counts} numbers", counts = counts.join(", "));
    Err(FileProblem::Parts { what: what(), found: found as u64, allowed })
}

struct Faces<'a> {
    vertices: &'a Vertices,
    /// The numbers of vertices, texture coordinates and normals so far: negative indices count back from here.
    so_far: [usize; 3],
    corners: Vec<Corner>,
    /// `None` until it is needed: a file whose first face has a material has no slot without one.
    material: Option<u16>,
    builder: MeshBuilder,
}

/// The indices of one corner, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Corner {
    vertex: usize,
    has_texture: bool,
    normal: Option<usize>,
}

impl<'a> Faces<'a> {
    fn new(vertices: &'a Vertices) -> Self {
        Self { vertices, so_far: [0; 3], corners: Vec::new(), material: None, builder: MeshBuilder::default() }
    }

    fn read(&mut self, keyword: &[u8], rest: &[u8]) -> Result<(), FileProblem> {
        match keyword {
            b"v" => self.so_far[0] += 1,
            b"vt" => self.so_far[1] += 1,
            b"vn" => self.so_far[2] += 1,
            b"f" | b"fo" => return self.face(rest),
            b"usemtl" => {
                // The rest of the line is the name, including spaces.
                let name = String::from_utf8_lossy(rest.trim_ascii());
                let name = Some(name.as_ref()).filter(|name| !name.is_empty());
                self.material = Some(self.builder.materials.slot(name)?);
            }
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, rest: &[u8]) -> Result<(), FileProblem> {
        self.corners.clear();
        for word in words(rest) {
            let corner = self.corner(word)?;
            self.corners.push(corner);
        }
        let [first, between @ ..] = self.corners.as_slice() else { return Err(too_few(0)) };
        if between.len() < 2 {
            return Err(too_few(1 + between.len()));
        }
        let form = |corner: &Corner| (corner.has_texture, corner.normal.is_some());
        if let Some(other) = between.iter().position(|corner| form(corner) != form(first)) {
            return Err(FileProblem::Unexpected {
                what: message!("corner {number} of the face", number = other + 2),
                found: words(rest).nth(other + 1).map(shown).unwrap_or_default(),
                allowed: message!("the form of the first corner (v, v/vt, v//vn or v/vt/vn)"),
            });
        }
        let material = match self.material {
            Some(material) => material,
            None => *self.material.insert(self.builder.materials.slot(None)?),
        };
        for pair in between.windows(2) {
            let triangle = [*first, pair[0], pair[1]];
            let positions = triangle.map(|corner| self.vertices.positions[corner.vertex]);
            let normal = |corner: Corner| corner.normal.map(|index| (self.vertices.normals[index], index as u64 + 1));
            let normals = match triangle.map(normal) {
                [Some(a), Some(b), Some(c)] => Some([a, b, c]),
                _ => NO_NORMALS,
            };
            self.builder.triangle(positions, normals, material)?;
        }
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &[u8]) -> Result<Corner, FileProblem> {
        let mut parts = word.split(|byte| *byte == b'/');
        let vertex = parts.next().unwrap_or_default();
        let texture = parts.next();
        let normal = parts.next();
        let has_texture = texture.is_some_and(|texture| !texture.is_empty());
        if parts.next().is_some() || (texture.is_some() && !has_texture && normal.is_none()) {
            let allowed = message!("v, v/vt, v//vn or v/vt/vn");
            return Err(FileProblem::Unexpected { what: message!("a corner"), found: shown(word), allowed });
        }
        let [positions, textures, normals] =
            [self.vertices.positions.len(), self.vertices.textures, self.vertices.normals.len()];
        let vertex = index(vertex, || message!("the vertex index"), positions, self.so_far[0])?;
        if let Some(texture) = texture.filter(|_| has_texture) {
            index(texture, || message!("the texture index"), textures, self.so_far[1])?;
        }
        let normal =
            normal.map(|normal| index(normal, || message!("the normal index"), normals, self.so_far[2])).transpose()?;
        Ok(Corner { vertex, has_texture, normal })
    }
}

fn too_few(found: usize) -> FileProblem {
    FileProblem::Parts {
        what: message!("the face"),
        found: found as u64,
        allowed: message!("at least 3 corners are needed"),
    }
}

/// From 1 upwards, or from −1 downwards, counting back from the vertices so far.
fn index(word: &[u8], field: fn() -> Message, count: usize, so_far: usize) -> Result<usize, FileProblem> {
    let index = integer(word, field)?;
    let from_start = usize::try_from(index).ok().and_then(|index| index.checked_sub(1)).filter(|index| *index < count);
    let from_here = usize::try_from(index.unsigned_abs()).ok().and_then(|back| so_far.checked_sub(back));
    let found = if index < 0 { from_here } else { from_start };
    let (count, backwards) = (count as u64, so_far as u64);
    found.ok_or_else(|| FileProblem::Index { field: field(), index, first: 1, count, backwards })
}

//! Numbers for shaders: written by name, at the places that the WGSL struct itself states. Nothing is kept in step by hand.

use std::collections::BTreeMap;

/// A struct of WGSL as the front end lays it out.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    /// Bytes.
    pub size: usize,
    /// Members by name.
    members: Vec<Member>,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Member {
    name: String,
    offset: usize,
    size: usize,
}

/// Members that a struct has at most: a bit of a word stands for each.
const MAX_MEMBERS: usize = 128;

impl Layout {
    /// The structs of a WGSL text by name.
    pub fn of_structs(text: &str) -> Result<BTreeMap<String, Self>, naga::front::wgsl::ParseError> {
        let module = naga::front::wgsl::parse_str(text)?;
        let mut layouter = naga::proc::Layouter::default();
        // Sizes of what the front end accepted are known.
        let _ = layouter.update(module.to_ctx());
        let structs = module.types.iter().filter_map(|(_, ty)| {
            let naga::TypeInner::Struct { members, span } = &ty.inner else { return None };
            let member = |m: &naga::StructMember| {
                Some(Member { name: m.name.clone()?, offset: m.offset as usize, size: layouter[m.ty].size as usize })
            };
            let mut members: Vec<Member> = members.iter().filter_map(member).take(MAX_MEMBERS).collect();
            members.sort();
            Some((ty.name.clone()?, Self { size: *span as usize, members }))
        });
        Ok(structs.collect())
    }

    /// The struct of this name in one of our own files.
    pub fn of(text: &str, name: &str) -> Self {
        let texts: String = struct_texts(text).collect();
        let found = Self::of_structs(&texts).ok().and_then(|mut structs| structs.remove(name));
        // Tests reach every one of them.
        found.unwrap_or_else(|| panic!("there is no valid struct {name} in its file"))
    }

    /// Whether it has this member.
    pub fn has(&self, member: &str) -> bool {
        self.index(member).is_some()
    }

    /// Offset of a member.
    #[cfg(test)]
    pub fn offset(&self, member: &str) -> Option<usize> {
        self.index(member).map(|i| self.members[i].offset)
    }

    fn index(&self, member: &str) -> Option<usize> {
        self.members.binary_search_by(|m| m.name.as_str().cmp(member)).ok()
    }
}

/// The struct declarations of a WGSL text.
pub(crate) fn struct_texts(text: &str) -> impl Iterator<Item = String> {
    text.match_indices("struct ").filter(|(at, _)| *at == 0 || text.as_bytes()[at - 1] == b'\n').filter_map(
        |(at, _)| {
            let end = text[at..].find("\n}").map(|e| at + e + 2);
            let on_one_line = text[at..].lines().next().filter(|line| line.contains('}'));
            let declared = on_one_line.or_else(|| text.get(at..end?))?;
            Some(format!("{declared}\n"))
        },
    )
}

/// Bytes of one WGSL struct that are being written.
#[derive(Debug)]
pub struct Block<'a> {
    layout: &'a Layout,
    bytes: &'a mut [u8],
    /// A bit for each member that is written, and for each that holds the field of its name.
    put: u128,
    taken: u128,
    /// Members in the order in which they were last written, and how many of them have been now: the same as last time.
    order: Vec<usize>,
    at: usize,
    /// Fields of another size than the member of their name: members and sizes.
    unfit: Vec<(usize, usize)>,
    faults: Vec<String>,
}

impl<'a> Block<'a> {
    pub(crate) fn new(layout: &'a Layout, bytes: &'a mut [u8]) -> Self {
        Self { layout, bytes, put: 0, taken: 0, order: Vec::new(), at: 0, unfit: Vec::new(), faults: Vec::new() }
    }

    /// Place of a member, which is mostly that of last time.
    fn find(&mut self, member: &str) -> Option<usize> {
        let known = self.order.get(self.at).copied().filter(|i| self.layout.members[*i].name == member);
        let found = known.or_else(|| self.layout.index(member))?;
        if known.is_none() {
            self.order.truncate(self.at);
            self.order.push(found);
        }
        self.at += 1;
        Some(found)
    }

    /// Writes the numbers of a field into the member of its name, where there is one; nothing where it has none now.
    pub(crate) fn take(&mut self, field: &str, value: &[u8]) {
        let Some(index) = self.layout.index(field) else { return };
        let Member { offset, size, .. } = self.layout.members[index];
        if value.len() == size {
            self.bytes[offset..offset + size].copy_from_slice(value);
        } else if !value.is_empty() {
            self.unfit.push((index, value.len()));
        }
        self.taken |= 1 << index;
    }

    /// Writes a member: a number, a vector as an array, a matrix as its columns with four numbers each.
    pub fn put<T: bytemuck::NoUninit>(&mut self, member: &str, value: T) {
        let Some(index) = self.find(member) else {
            self.faults.push(format!("there is no member {member}"));
            return;
        };
        let Member { offset, size, .. } = self.layout.members[index];
        let value = bytemuck::bytes_of(&value);
        if value.len() != size {
            self.faults.push(format!("the member {member} has {size} bytes, not {}", value.len()));
        } else if self.put & (1 << index) != 0 {
            self.faults.push(format!("the member {member} is written twice"));
        } else {
            self.bytes[offset..offset + size].copy_from_slice(value);
        }
        self.put |= 1 << index;
    }

    /// What is wrong: members that nobody wrote, that do not exist, or that are of another size.
    pub(crate) fn faults(self) -> Vec<String> {
        let Self { layout, put, taken, unfit, mut faults, .. } = self;
        for (index, size) in unfit.into_iter().filter(|(index, _)| put & (1 << index) == 0) {
            let member = &layout.members[index];
            faults.push(format!("the member {} has {} bytes, its field {size}", member.name, member.size));
        }
        let missing = layout.members.iter().enumerate().filter(|(i, _)| (put | taken) & (1 << i) == 0);
        faults.extend(missing.map(|(_, m)| format!("nobody writes the member {}", m.name)));
        faults
    }
}

/// Numbers of a struct of ours: its layout, and its bytes as they were written last.
#[derive(Debug)]
pub(crate) struct Filled {
    layout: Layout,
    bytes: Vec<u8>,
    /// In which its members are written.
    order: Vec<usize>,
}

impl Filled {
    /// The struct of this name in a file of `wgsl/`.
    pub fn of(module: &str, name: &str) -> Self {
        let layout = Layout::of(super::shaders::file(module), name);
        Self { bytes: vec![0; layout.size], layout, order: Vec::new() }
    }

    /// The same of a struct that has members of others.
    pub fn of_file(module: &str, imports: &[&str], name: &str) -> Self {
        let texts = imports.iter().chain([&module]).map(|module| super::shaders::file(module));
        let layout = Layout::of(&texts.collect::<Vec<_>>().join("\n"), name);
        Self { bytes: vec![0; layout.size], layout, order: Vec::new() }
    }

    /// Its size, bytes.
    pub fn size(&self) -> u64 {
        self.layout.size as u64
    }

    /// Its bytes after `fill` has written every member.
    ///
    /// # Panics
    /// Where a member is missing or does not exist: a fault of ours, which any test that draws finds.
    pub fn fill(&mut self, fill: impl FnOnce(&mut Block<'_>)) -> &[u8] {
        let mut block = Block::new(&self.layout, &mut self.bytes);
        block.order = std::mem::take(&mut self.order);
        fill(&mut block);
        self.order = std::mem::take(&mut block.order);
        let faults = block.faults();
        assert!(faults.is_empty(), "{}", faults.join("; "));
        &self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// A comment.\nstruct A { x: f32 }\n\nstruct Some {\n    a: vec3f,\n    // One.\n    b: f32,\n    \
                        c: mat3x3f,\n    d: array<vec4f, 2>,\n}\nfn f() -> f32 { return 1.0; }\n";

    #[test]
    fn members_lie_where_the_front_end_says() {
        let layout = Layout::of(TEXT, "Some");
        let mut filled = Filled { bytes: vec![0; layout.size], layout, order: Vec::new() };
        let bytes = filled.fill(|b| {
            b.put("a", [1f32, 2.0, 3.0]);
            b.put("b", 4f32);
            b.put("c", [[5f32; 4]; 3]);
            b.put("d", [6f32; 8]);
        });
        let words: Vec<f32> = bytemuck::pod_collect_to_vec(bytes);
        assert_eq!(words[..4], [1.0, 2.0, 3.0, 4.0]);
        assert_eq!((words[4], words[16], words.len()), (5.0, 6.0, 24));
    }

    #[test]
    fn members_hold_the_fields_of_their_names() {
        let layout = Layout::of(TEXT, "Some");
        let mut bytes = vec![0; layout.size];
        let mut block = Block::new(&layout, &mut bytes);
        block.take("a", bytemuck::bytes_of(&[1f32, 2.0, 3.0]));
        block.take("b", bytemuck::bytes_of(&1f32));
        block.take("c", &[]);
        block.take("d", bytemuck::bytes_of(&[1f32; 3]));
        block.take("unknown", &[0; 4]);
        // What a section derives takes the place of the field.
        block.put("b", 2f32);
        assert_eq!(block.faults(), ["the member d has 32 bytes, its field 12"]);
        assert_eq!(bytemuck::pod_collect_to_vec::<u8, f32>(&bytes)[..4], [1.0, 2.0, 3.0, 2.0]);
    }

    #[test]
    fn what_is_missing_unknown_twice_or_of_another_size_is_a_fault() {
        let layout = Layout::of(TEXT, "Some");
        let mut bytes = vec![0; layout.size];
        let mut block = Block::new(&layout, &mut bytes);
        block.put("a", [1f32; 4]);
        block.put("b", 1f32);
        block.put("b", 1f32);
        block.put("e", 1f32);
        let faults = block.faults().join("; ");
        for word in ["a has 12 bytes, not 16", "b is written twice", "no member e", "nobody writes the member c"] {
            assert!(faults.contains(word), "{faults}");
        }
    }
}

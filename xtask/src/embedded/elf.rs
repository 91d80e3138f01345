//! As much of an ELF file for a 32-bit Arm as the bound of the stack needs.

/// A function and where its code lies.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Function {
    pub(super) name: String,
    /// Address of its first instruction.
    pub(super) start: u32,
    /// Bytes.
    pub(super) size: u32,
}

/// Where code or data begins inside the code, by the assembler's marks `$t` and `$d`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mark {
    pub(super) address: u32,
    pub(super) data: bool,
}

/// A program.
pub(super) struct Elf<'a> {
    bytes: &'a [u8],
    sections: Vec<Section>,
}

struct Section {
    name: u32,
    kind: u32,
    address: u32,
    offset: u32,
    size: u32,
    link: u32,
}

/// Kind of the section that holds the symbols.
const SYMBOLS: u32 = 2;
/// Kind of a symbol that is a function.
const FUNCTION: u8 = 2;

fn half(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from(u16::from_le_bytes(bytes.get(at..at + 2)?.try_into().ok()?)))
}

/// The word at a place.
pub(super) fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

impl<'a> Elf<'a> {
    /// Read the table of sections.
    pub(super) fn read(bytes: &'a [u8]) -> Option<Self> {
        if bytes.get(..6)? != b"\x7fELF\x01\x01" {
            return None;
        }
        let (table, each, count) = (word(bytes, 32)?, half(bytes, 46)?, half(bytes, 48)?);
        let section = |k: u32| {
            let at = (table + k * each) as usize;
            Some(Section {
                name: word(bytes, at)?,
                kind: word(bytes, at + 4)?,
                address: word(bytes, at + 12)?,
                offset: word(bytes, at + 16)?,
                size: word(bytes, at + 20)?,
                link: word(bytes, at + 24)?,
            })
        };
        Some(Self { bytes, sections: (0..count).map(section).collect::<Option<_>>()? })
    }

    /// Address and contents of the section of this name.
    pub(super) fn section(&self, name: &str) -> Option<(u32, &'a [u8])> {
        let names = self.sections.get(half(self.bytes, 50)? as usize)?;
        let found = self.sections.iter().find(|s| self.text(names, s.name) == Some(name))?;
        Some((found.address, self.contents(found)?))
    }

    /// All functions and all marks, by address.
    pub(super) fn symbols(&self) -> Option<(Vec<Function>, Vec<Mark>)> {
        let table = self.sections.iter().find(|s| s.kind == SYMBOLS)?;
        let names = self.sections.get(table.link as usize)?;
        let (mut functions, mut marks) = (Vec::new(), Vec::new());
        for symbol in self.contents(table)?.chunks_exact(16) {
            let (name, value) = (self.text(names, word(symbol, 0)?)?, word(symbol, 4)?);
            if symbol[12] & 15 == FUNCTION {
                // The lowest bit says that the code is Thumb.
                let (start, size) = (value & !1, word(symbol, 8)?);
                functions.push(Function { name: name.to_owned(), start, size });
            } else if name.starts_with("$d") || name.starts_with("$t") {
                marks.push(Mark { address: value, data: name.starts_with("$d") });
            }
        }
        functions.sort_by_key(|f| f.start);
        functions.dedup_by_key(|f| f.start);
        marks.sort_by_key(|m| m.address);
        Some((functions, marks))
    }

    fn contents(&self, section: &Section) -> Option<&'a [u8]> {
        self.bytes.get(section.offset as usize..(section.offset + section.size) as usize)
    }

    fn text(&self, table: &Section, at: u32) -> Option<&'a str> {
        let from = self.contents(table)?.get(at as usize..)?;
        let end = from.iter().position(|b| *b == 0)?;
        std::str::from_utf8(&from[..end]).ok()
    }
}

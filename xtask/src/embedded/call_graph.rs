//! Which function of a firmware calls which, read from its code, and how much stack each takes.

use object::read::elf::ElfFile32;
use object::{LittleEndian, Object, ObjectSection, ObjectSymbol, SymbolKind};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// A function and where its code lies.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Function {
    pub(super) name: String,
    /// Address of its first instruction.
    pub(super) start: u32,
    /// Bytes.
    size: u32,
}

/// Where code or data begins inside the code, by the assembler's marks `$t` and `$d`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mark {
    address: u32,
    data: bool,
}

type Elf<'a> = ElfFile32<'a, LittleEndian>;

/// What a function of the program calls, and how much stack it takes itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Node {
    /// Bytes; nothing if the compiler did not note it.
    pub(super) frame: Option<u32>,
    /// Addresses of the functions that it calls.
    pub(super) calls: Vec<u32>,
    /// Whether it calls a function whose address is not in the code.
    pub(super) indirect: bool,
}

/// All functions of a program.
pub(super) struct CallGraph {
    /// By address.
    pub(super) functions: Vec<Function>,
    /// By address of the function.
    pub(super) nodes: BTreeMap<u32, Node>,
}

impl CallGraph {
    /// From the file of a program.
    pub(super) fn read(program: &Path) -> Result<Self, String> {
        let bytes = fs::read(program).map_err(|why| format!("{}: {why}", program.display()))?;
        let unreadable = "the firmware's symbols, code or stack sizes cannot be read";
        let elf: Elf<'_> = ElfFile32::parse(bytes.as_slice())
            .map_err(|why| format!("the firmware is not an ELF file for 32 bits: {why}"))?;
        let (functions, marks) = symbols(&elf).ok_or(unreadable)?;
        let (address, code) = section(&elf, ".text").ok_or(unreadable)?;
        let frames =
            frames(section(&elf, ".stack_sizes").ok_or(unreadable)?.1).ok_or(unreadable)?;
        let mut nodes = BTreeMap::new();
        for function in &functions {
            let mut node = calls(function, &functions, &marks, address, code).ok_or(unreadable)?;
            node.frame = frames.get(&function.start).copied();
            nodes.insert(function.start, node);
        }
        Ok(Self { functions, nodes })
    }

    /// Name of the function at an address.
    pub(super) fn name(&self, at: u32) -> &str {
        self.functions.iter().find(|f| f.start == at).map_or("?", |f| &f.name)
    }

    /// Names of the functions that call one whose name contains `part`, in order.
    pub(super) fn callers_of(&self, part: &str) -> Vec<&str> {
        let calls = |node: &Node| node.calls.iter().any(|at| self.name(*at).contains(part));
        let callers = self.nodes.iter().filter(|(_, node)| calls(node));
        callers.map(|(at, _)| self.name(*at)).collect()
    }
}

/// Address and contents of the section of this name.
fn section<'a>(elf: &Elf<'a>, name: &str) -> Option<(u32, &'a [u8])> {
    let section = elf.section_by_name(name)?;
    Some((u32::try_from(section.address()).ok()?, section.data().ok()?))
}

/// All functions and all marks, by address.
fn symbols(elf: &Elf<'_>) -> Option<(Vec<Function>, Vec<Mark>)> {
    let (mut functions, mut marks) = (Vec::new(), Vec::new());
    for symbol in elf.symbols() {
        let (name, address) = (symbol.name().ok()?, u32::try_from(symbol.address()).ok()?);
        if symbol.kind() == SymbolKind::Text {
            // The lowest bit says that the code is Thumb.
            let (start, size) = (address & !1, u32::try_from(symbol.size()).ok()?);
            functions.push(Function { name: name.to_owned(), start, size });
        } else if name.starts_with("$d") || name.starts_with("$t") {
            marks.push(Mark { address, data: name.starts_with("$d") });
        }
    }
    functions.sort_by_key(|f| f.start);
    functions.dedup_by_key(|f| f.start);
    marks.sort_by_key(|m| m.address);
    Some((functions, marks))
}

/// Frame by address: words of four bytes, each followed by a number in LEB128.
fn frames(mut section: &[u8]) -> Option<BTreeMap<u32, u32>> {
    let mut frames = BTreeMap::new();
    while !section.is_empty() {
        let start = u32::from_le_bytes(*section.first_chunk()?) & !1;
        let (mut size, mut shift, mut at) = (0_u32, 0, 4);
        loop {
            let byte = *section.get(at)?;
            size |= u32::from(byte & 0x7F).checked_shl(shift)?;
            (shift, at) = (shift + 7, at + 1);
            if byte & 0x80 == 0 {
                break;
            }
        }
        frames.insert(start, size);
        section = section.get(at..)?;
    }
    Some(frames)
}

/// What a function calls. Thumb: `BL`, a wide branch out of the function, `BLX` and `BX` by register.
fn calls(
    function: &Function,
    functions: &[Function],
    marks: &[Mark],
    address: u32,
    code: &[u8],
) -> Option<Node> {
    let mut node = Node::default();
    let end = function.start + function.size;
    let mut at = function.start;
    while at < end {
        let data = marks.iter().rev().find(|m| m.address <= at).is_some_and(|m| m.data);
        let offset = (at - address) as usize;
        let first = u16::from_le_bytes(code.get(offset..offset + 2)?.try_into().ok()?);
        if data || first >> 11 < 0b11101 {
            // By register: BX lr is the return; BLX and other BX are calls to somewhere.
            node.indirect |= !data && first & 0xFF07 == 0x4700 && first != 0x4770;
            at += 2;
            continue;
        }
        let second = u16::from_le_bytes(code.get(offset + 2..offset + 4)?.try_into().ok()?);
        if let Some(target) = branch(at, first, second)
            && !(function.start..end).contains(&target)
        {
            let callee = functions.iter().rev().find(|f| f.start <= target);
            node.calls.push(callee.map_or(target, |f| f.start));
        }
        at += 4;
    }
    Some(node)
}

/// Target of `BL` or of an unconditional wide `B` (Armv7-M manual, A7.7.12 and A7.7.18).
fn branch(at: u32, first: u16, second: u16) -> Option<u32> {
    let (first, second) = (u32::from(first), u32::from(second));
    if first >> 11 != 0b11110 || second & 0x9000 != 0x9000 {
        return None;
    }
    let sign = first >> 10 & 1;
    let i1 = !((second >> 13 & 1) ^ sign) & 1;
    let i2 = !((second >> 11 & 1) ^ sign) & 1;
    let distance = sign << 24 | i1 << 23 | i2 << 22 | (first & 0x3FF) << 12 | (second & 0x7FF) << 1;
    // Sign of 25 bits.
    let distance = if sign == 1 { distance | 0xFE00_0000 } else { distance };
    Some(at.wrapping_add(4).wrapping_add(distance))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two branches as an assembler encodes them: `bl` 16 bytes on, `b.w` 4 bytes back.
    #[test]
    fn branches_go_where_the_manual_says() {
        assert_eq!(branch(0x100, 0xF000, 0xF806), Some(0x110));
        assert_eq!(branch(0x100, 0xF7FF, 0xBFFC), Some(0xFC));
        assert_eq!(branch(0x100, 0xF3BF, 0x8F4F), None, "a barrier is no branch");
    }

    #[test]
    fn sizes_of_more_than_one_byte_are_read() {
        let section = [0x01, 0x10, 0, 0, 0x08, 0x21, 0x10, 0, 0, 0x88, 0x0E];
        let expected = BTreeMap::from([(0x1000, 8), (0x1020, 0x708)]);
        assert_eq!(frames(&section), Some(expected));
    }
}

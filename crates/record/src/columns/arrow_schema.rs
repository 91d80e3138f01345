//! The Arrow schema of a table, which Parquet files carry so that a column has metadata of its own: the
//! readers of Arrow, polars and pandas find unit and meaning there.
//!
//! # Source
//! Apache Arrow, *Schema.fbs* and *Message.fbs*, format 1.5 (metadata version V5): numbers of the fields and
//! of the union's members are those of these files.

use super::{Field, Kind};
use data_encoding::BASE64;
use flatbuffers::{FlatBufferBuilder, TableUnfinishedWIPOffset, VOffsetT, WIPOffset};

/// The key under which Parquet files carry it.
pub(super) const KEY: &str = "ARROW:schema";

/// A table of a buffer, whatever its kind.
type Offset = WIPOffset<TableUnfinishedWIPOffset>;

/// Place of the field of a number in a table's index.
const fn slot(number: VOffsetT) -> VOffsetT {
    4 + 2 * number
}

const METADATA_V5: i16 = 4;
const HEADER_SCHEMA: u8 = 1;

/// The schema as the text that a Parquet file carries: an encapsulated message in base64.
pub(super) fn encoded(fields: &[Field]) -> String {
    let mut buffer = FlatBufferBuilder::new();
    let fields: Vec<Offset> = fields.iter().map(|field| described(&mut buffer, field)).collect();
    let fields = buffer.create_vector(&fields);
    let schema = buffer.start_table();
    buffer.push_slot_always(slot(1), fields);
    let schema = buffer.end_table(schema);
    let message = buffer.start_table();
    buffer.push_slot_always(slot(2), schema);
    buffer.push_slot_always(slot(0), METADATA_V5);
    buffer.push_slot_always(slot(1), HEADER_SCHEMA);
    let message = buffer.end_table(message);
    buffer.finish_minimal(message);
    let mut body = buffer.finished_data().to_vec();
    // To whole words, behind the mark of a message and its length.
    body.resize(body.len().next_multiple_of(8), 0);
    let length = u32::try_from(body.len()).expect("a schema is smaller than four gigabytes");
    let head = [[0xff; 4], length.to_le_bytes()].concat();
    BASE64.encode(&[head, body].concat())
}

/// A field with its type and metadata.
fn described(buffer: &mut FlatBufferBuilder<'_>, field: &Field) -> Offset {
    let pairs = [("unit", &field.unit), ("meaning", &field.meaning)];
    let pairs: Vec<Offset> = pairs.iter().map(|(key, value)| pair(buffer, key, value)).collect();
    let metadata = buffer.create_vector(&pairs);
    let children = buffer.create_vector::<Offset>(&[]);
    let name = buffer.create_string(&field.name);
    let (number, kind) = kind(buffer, field.kind);
    let table = buffer.start_table();
    buffer.push_slot_always(slot(0), name);
    buffer.push_slot_always(slot(1), field.has_nulls);
    buffer.push_slot_always(slot(2), number);
    buffer.push_slot_always(slot(3), kind);
    buffer.push_slot_always(slot(5), children);
    buffer.push_slot_always(slot(6), metadata);
    finished(buffer, table)
}

fn pair(buffer: &mut FlatBufferBuilder<'_>, key: &str, value: &str) -> Offset {
    let (key, value) = (buffer.create_string(key), buffer.create_string(value));
    let table = buffer.start_table();
    buffer.push_slot_always(slot(0), key);
    buffer.push_slot_always(slot(1), value);
    finished(buffer, table)
}

/// Number of a type among the members of the union, and what it says of itself.
fn kind(buffer: &mut FlatBufferBuilder<'_>, kind: Kind) -> (u8, Offset) {
    let table = buffer.start_table();
    let number = match kind {
        Kind::Whole => {
            buffer.push_slot_always(slot(0), 64_i32);
            buffer.push_slot_always(slot(1), true);
            2
        }
        Kind::Number => {
            // Double precision.
            buffer.push_slot_always(slot(0), 2_i16);
            3
        }
        Kind::Text => 5,
        Kind::Flag => 6,
    };
    (number, finished(buffer, table))
}

fn finished(buffer: &mut FlatBufferBuilder<'_>, table: Offset) -> Offset {
    WIPOffset::new(buffer.end_table(table).value())
}

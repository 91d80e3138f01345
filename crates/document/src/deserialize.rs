//! A positioned tree as what serde reads from. It calls the one method of a visitor that the asked
//! type stands for: a method is compiled for each struct of a format and each crate that reads it, and
//! `toml::Value`, which offers every visitor all of them, was a third of what the readers compile to.

use crate::positioned::{Entry, Positioned, Table, Value};
use serde::de::value::StrDeserializer;
use serde::de::{self, Error, Expected, IntoDeserializer, Unexpected};
use serde::forward_to_deserialize_any;
use std::collections::btree_map;
use std::fmt;
use std::slice;

/// What serde says of a tree that does not fit, and the keys above it, innermost first.
#[derive(Debug)]
pub(crate) struct Misfit {
    message: String,
    keys: Vec<String>,
}

impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        if self.keys.is_empty() {
            return Ok(());
        }
        let path: Vec<&str> = self.keys.iter().rev().map(String::as_str).collect();
        write!(f, ", in `{}`", path.join("."))
    }
}

impl std::error::Error for Misfit {}

impl de::Error for Misfit {
    fn custom<M: fmt::Display>(message: M) -> Self {
        Self { message: message.to_string(), keys: vec![] }
    }
}

impl Misfit {
    fn below(mut self, key: &str) -> Self {
        self.keys.push(key.to_owned());
        self
    }
}

impl Value {
    /// Apart from the visitors, so that it is compiled once.
    fn misfit(&self, expected: &dyn Expected) -> Misfit {
        let found = match self {
            Self::String(text) => Unexpected::Str(text),
            Self::Integer(number) => Unexpected::Signed(*number),
            Self::Float(number) => Unexpected::Float(*number),
            Self::Boolean(flag) => Unexpected::Bool(*flag),
            Self::Datetime(_) => Unexpected::Other("date"),
            Self::Array(_) => Unexpected::Seq,
            Self::Table(_) => Unexpected::Map,
        };
        Misfit::invalid_type(found, expected)
    }
}

/// A table as a map: the whole document, or one in it.
fn map<'a, V: de::Visitor<'a>>(table: &'a Table, visitor: V) -> Result<V::Value, Misfit> {
    let mut entries = Entries { left: table.iter(), value: None };
    let value = visitor.visit_map(&mut entries)?;
    fully_read(table.len(), entries.left.len(), &"fewer elements in map")?;
    Ok(value)
}

fn list<'a, V: de::Visitor<'a>>(items: &'a [Positioned], visitor: V) -> Result<V::Value, Misfit> {
    let mut left = Items { left: items.iter() };
    let value = visitor.visit_seq(&mut left)?;
    fully_read(items.len(), left.left.len(), &"fewer elements in array")?;
    Ok(value)
}

fn fully_read(all: usize, left: usize, expected: &dyn Expected) -> Result<(), Misfit> {
    if left == 0 { Ok(()) } else { Err(Misfit::invalid_length(all, expected)) }
}

/// A root whose shape is a table.
pub(crate) struct Root<'a>(pub(crate) &'a Table);

impl<'de> de::Deserializer<'de> for Root<'de> {
    type Error = Misfit;

    fn deserialize_any<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        map(self.0, visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

impl Value {
    fn flag<'a, V: de::Visitor<'a>>(&'a self, visitor: V) -> Result<V::Value, Misfit> {
        match self {
            Self::Boolean(flag) => visitor.visit_bool(*flag),
            other => Err(other.misfit(&visitor)),
        }
    }

    fn integer<'a, V: de::Visitor<'a>>(&'a self, visitor: V) -> Result<V::Value, Misfit> {
        match self {
            Self::Integer(number) => visitor.visit_i64(*number),
            other => Err(other.misfit(&visitor)),
        }
    }

    fn number<'a, V: de::Visitor<'a>>(&'a self, visitor: V) -> Result<V::Value, Misfit> {
        match self {
            Self::Float(number) => visitor.visit_f64(*number),
            other => other.integer(visitor),
        }
    }

    fn word<'a, V: de::Visitor<'a>>(&'a self, visitor: V) -> Result<V::Value, Misfit> {
        match self {
            Self::String(text) => visitor.visit_str(text),
            Self::Datetime(date) => visitor.visit_str(&date.to_string()),
            other => Err(other.misfit(&visitor)),
        }
    }

    fn list<'a, V: de::Visitor<'a>>(&'a self, visitor: V) -> Result<V::Value, Misfit> {
        match self {
            Self::Array(items) => list(items, visitor),
            other => Err(other.misfit(&visitor)),
        }
    }

    fn map<'a, V: de::Visitor<'a>>(&'a self, visitor: V) -> Result<V::Value, Misfit> {
        match self {
            Self::Table(table) => map(table, visitor),
            other => Err(other.misfit(&visitor)),
        }
    }
}

/// Lets methods of a deserializer be a method of the value.
macro_rules! are {
    ($to:ident: $($method:ident)+) => {$(
        fn $method<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
            self.$to(visitor)
        }
    )+};
}

impl<'de> de::Deserializer<'de> for &'de Value {
    type Error = Misfit;

    are!(flag: deserialize_bool);
    are!(integer: deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64);
    are!(integer: deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64);
    are!(number: deserialize_f32 deserialize_f64);
    are!(word: deserialize_char deserialize_str deserialize_string deserialize_identifier);
    are!(list: deserialize_seq);
    are!(map: deserialize_map);

    fn deserialize_any<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self {
            Value::Boolean(_) => self.flag(visitor),
            Value::Integer(_) | Value::Float(_) => self.number(visitor),
            Value::String(_) | Value::Datetime(_) => self.word(visitor),
            Value::Array(items) => list(items, visitor),
            Value::Table(table) => map(table, visitor),
        }
    }

    fn deserialize_tuple<V: de::Visitor<'de>>(
        self,
        _length: usize,
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        self.list(visitor)
    }

    fn deserialize_struct<V: de::Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        self.map(visitor)
    }

    /// A key that stands there has a value: TOML knows no other.
    fn deserialize_option<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: de::Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: de::Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        visitor.visit_enum(self.variant()?)
    }

    fn deserialize_ignored_any<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        visitor.visit_unit()
    }

    forward_to_deserialize_any! { bytes byte_buf unit unit_struct tuple_struct }
}

struct Entries<'a> {
    left: btree_map::Iter<'a, String, Entry>,
    /// The value whose key was read last.
    value: Option<(&'a str, &'a Value)>,
}

impl<'a> Entries<'a> {
    fn next_key(&mut self) -> Option<StrDeserializer<'a, Misfit>> {
        let (key, entry) = self.left.next()?;
        self.value = Some((key, &entry.item.value));
        Some(key.as_str().into_deserializer())
    }
    fn next_value(&mut self) -> Result<(&'a str, &'a Value), Misfit> {
        self.value.take().ok_or_else(|| Misfit::custom("value is missing"))
    }
}

impl<'a> de::MapAccess<'a> for Entries<'a> {
    type Error = Misfit;

    fn next_key_seed<S: de::DeserializeSeed<'a>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Misfit> {
        self.next_key().map(|key| seed.deserialize(key)).transpose()
    }

    fn next_value_seed<S: de::DeserializeSeed<'a>>(&mut self, seed: S) -> Result<S::Value, Misfit> {
        let (key, value) = self.next_value()?;
        seed.deserialize(value).map_err(|misfit| misfit.below(key))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.left.len())
    }
}

struct Items<'a> {
    left: slice::Iter<'a, Positioned>,
}

impl<'a> de::SeqAccess<'a> for Items<'a> {
    type Error = Misfit;

    fn next_element_seed<S: de::DeserializeSeed<'a>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, Misfit> {
        self.left.next().map(|item| seed.deserialize(&item.value)).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.left.len())
    }
}

/// One of an enum: its name alone, or a table of one key, which is its name.
struct Variant<'a> {
    name: &'a str,
    value: Option<&'a Value>,
}

impl Value {
    fn variant(&self) -> Result<Variant<'_>, Misfit> {
        match self {
            Self::String(name) => Ok(Variant { name, value: None }),
            Self::Table(table) => {
                let mut entries = table.iter();
                match (entries.next(), entries.next()) {
                    (Some((name, entry)), None) => {
                        Ok(Variant { name, value: Some(&entry.item.value) })
                    }
                    _ => Err(Misfit::custom("wanted exactly 1 element")),
                }
            }
            other => Err(other.misfit(&"string only")),
        }
    }
}

impl<'a> Variant<'a> {
    fn content(self) -> Result<&'a Value, Misfit> {
        self.value.ok_or_else(|| Misfit::invalid_type(Unexpected::UnitVariant, &"a table"))
    }
}

impl<'a> de::EnumAccess<'a> for Variant<'a> {
    type Error = Misfit;
    type Variant = Self;

    fn variant_seed<S: de::DeserializeSeed<'a>>(self, seed: S) -> Result<(S::Value, Self), Misfit> {
        let name: StrDeserializer<'a, Misfit> = self.name.into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'a> de::VariantAccess<'a> for Variant<'a> {
    type Error = Misfit;

    fn unit_variant(self) -> Result<(), Misfit> {
        match self.value {
            None => Ok(()),
            Some(Value::Table(table)) if table.is_empty() => Ok(()),
            Some(other) => Err(other.misfit(&"a name alone")),
        }
    }

    fn newtype_variant_seed<S: de::DeserializeSeed<'a>>(self, seed: S) -> Result<S::Value, Misfit> {
        seed.deserialize(self.content()?)
    }

    fn tuple_variant<V: de::Visitor<'a>>(
        self,
        _length: usize,
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        self.content()?.list(visitor)
    }

    fn struct_variant<V: de::Visitor<'a>>(
        self,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        self.content()?.map(visitor)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use crate::Document;
    use serde::Deserialize;
    use std::collections::BTreeMap;

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    enum Way {
        Straight,
        Turned { by_deg: f64 },
        Named(String),
    }

    #[derive(Debug, PartialEq, Deserialize)]
    struct Leg {
        way: Way,
        samples: u32,
        origin_m: [f64; 3],
        note: Option<String>,
    }

    type Legs = BTreeMap<String, Leg>;

    fn read(text: &str) -> Result<Legs, String> {
        let document = Document::parse("legs.toml", text).unwrap();
        document.deserialized().map_err(|complaints| complaints[0].message.clone())
    }

    fn leg(way: Way, note: Option<&str>) -> Leg {
        Leg { way, samples: 3, origin_m: [1.0, -2.5, f64::INFINITY], note: note.map(str::to_owned) }
    }

    #[test]
    fn every_kind_of_value_is_read_as_what_it_stands_for() {
        let rest = "samples = 3\norigin_m = [1, -2.5, inf]\n";
        let text = format!(
            "[a]\nway = \"straight\"\nnote = \"n\"\n{rest}[b]\nway = {{ turned = {{ by_deg = 90 }} }}\n\
             {rest}[c]\nway.named = \"west\"\n{rest}"
        );
        let legs = read(&text).unwrap();
        assert_eq!(legs["a"], leg(Way::Straight, Some("n")));
        assert_eq!(legs["b"], leg(Way::Turned { by_deg: 90.0 }, None));
        assert_eq!(legs["c"], leg(Way::Named("west".into()), None));
    }

    #[test]
    fn what_does_not_fit_is_named_with_the_keys_above_it() {
        let said = |text: &str| read(text).unwrap_err();
        let text = "[a]\nway = \"straight\"\nsamples = -1\norigin_m = [0, 0, 0]\n";
        assert_eq!(said(text), "invalid value: integer `-1`, expected u32, in `a.samples`");
        let text = "[a]\nway = 3\nsamples = 1\norigin_m = [0, 0, 0]\n";
        assert_eq!(said(text), "invalid type: integer `3`, expected string only, in `a.way`");
        let text = "[a]\norigin_m = [0, 0, 0, 0]\n";
        let long = "invalid length 4, expected fewer elements in array, in `a.origin_m`";
        assert_eq!(said(text), long);
    }
}

//! XML files as their readers see them, whatever the format.

mod element;
mod not_xml;
mod numbers;

pub(crate) use element::{Element, Format, Kind, Reading, Text, tag_at};
pub(crate) use not_xml::{check_attributes, not_xml};

//! OpenEXR: linear 32-bit float with layers and metadata.

use super::exr_order::sort_attributes;
use super::{ImageFile, ImageFormat, RgbImage32, Tone, check_size};
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Text};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatImage, FlatSamples, Image, ImageAttributes, Layer, LayerAttributes, Vec2,
    WritableImage,
};
use exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, SmallVec};
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "OpenEXR",
    extensions: &["exr"],
    about: "OpenEXR: linear RGB, 32-bit float, with layers and metadata",
    signatures: &[b"\x76\x2F\x31\x01"],
    read: Some(read),
    write: Some(write),
};

/// Names of our metadata in the file begin so, which keeps them apart from the format's own.
const PREFIX: &str = "sunfleck:";

/// A file may have at most this many channels in all its parts.
const MAX_CHANNELS: usize = 1024;

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    if is_plain(&check_header(bytes)?) {
        return read_plain(bytes);
    }
    let image: FlatImage = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| e.to_string())?;
    let metadata = metadata(&image.attributes, image.layer_data.iter().map(|part| &part.attributes));
    let mut pictures = Vec::new();
    let many_parts = image.layer_data.len() > 1;
    for part in image.layer_data {
        let part_name = part.attributes.layer_name.as_ref().filter(|_| many_parts).map(Text::to_string);
        let size = (part.size.width() as u32, part.size.height() as u32);
        pictures.extend(pictures_of_part(part.channel_data, part_name.as_deref(), size));
    }
    let is_colour = |p: &Picture| p.is_colour;
    let main = pictures
        .iter()
        .position(|p| p.name.is_empty() && p.is_colour)
        .or_else(|| pictures.iter().position(is_colour))
        .or_else(|| (!pictures.is_empty()).then_some(0))
        .ok_or("it has no channels")?;
    let image = pictures.remove(main).image;
    let same_size = |p: &Picture| (p.image.width, p.image.height) == (image.width, image.height);
    let layers = pictures.into_iter().filter(same_size).map(|p| (p.name, p.image)).collect();
    Ok(ImageFile { image, layers, metadata, ..ImageFile::default() })
}

/// Whether it holds one picture and nothing else but an opacity.
fn is_plain(meta: &MetaData) -> bool {
    let [part] = &meta.headers[..] else { return false };
    let is = |name: &str| part.channels.list.iter().any(|c| c.name == *name && c.sampling == Vec2(1, 1));
    let known = 3 + usize::from(is("A"));
    !part.deep && is("R") && is("G") && is("B") && part.channels.list.len() == known
}

/// Reads a picture that [`is_plain`], block by block into its place: a panorama should not be in memory twice.
fn read_plain(bytes: &[u8]) -> Result<ImageFile, String> {
    let canvas = |size: Vec2<usize>, _: &_| RgbImage32::filled(size.width() as u32, size.height() as u32, [0.0; 3]);
    let draw = |image: &mut RgbImage32, at: Vec2<usize>, (r, g, b): (f32, f32, f32)| {
        image.data[at.y() * image.width as usize + at.x()] = [r, g, b];
    };
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("R")
        .required("G")
        .required("B")
        .collect_pixels(canvas, draw)
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| e.to_string())?;
    let metadata = metadata(&read.attributes, std::iter::once(&read.layer_data.attributes));
    Ok(ImageFile { image: read.layer_data.channel_data.pixels, metadata, ..ImageFile::default() })
}

fn check_header(bytes: &[u8]) -> Result<MetaData, String> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|e| e.to_string())?;
    let channels: usize = meta.headers.iter().map(|h| h.channels.list.len()).sum();
    if channels > MAX_CHANNELS {
        return Err(format!("it has {channels} channels, more than {MAX_CHANNELS}"));
    }
    let mut stored = 0_u64;
    for header in &meta.headers {
        let (width, height) = (header.layer_size.width() as u64, header.layer_size.height() as u64);
        let channels = header.channels.list.len() as u64;
        stored = stored.saturating_add(width.saturating_mul(height).saturating_mul(2 * channels));
        check_size(width, height, stored, bytes.len())?;
    }
    Ok(meta)
}

fn metadata<'a>(
    shared: &'a ImageAttributes,
    parts: impl Iterator<Item = &'a LayerAttributes>,
) -> Vec<(String, String)> {
    let shared = shared.other.iter();
    let of_parts = parts.flat_map(|part| &part.other);
    let mut all: Vec<(String, String)> = shared
        .chain(of_parts)
        .filter_map(|(name, value)| {
            let AttributeValue::Text(text) = value else { return None };
            let name = name.to_string();
            let value = String::from_utf8(text.as_slice().to_vec()).unwrap_or_else(|_| text.to_string());
            Some((name.strip_prefix(PREFIX).unwrap_or(&name).to_owned(), value))
        })
        .collect();
    all.sort_unstable();
    all.dedup_by(|a, b| a.0 == b.0);
    all
}

struct Picture {
    name: String,
    image: RgbImage32,
    is_colour: bool,
}

/// Channels that share all of their name but the last word: `layer.R`, `layer.G`, `layer.B`.
type Group = (String, Vec<AnyChannel<FlatSamples>>);

fn group_channels(channels: AnyChannels<FlatSamples>, pixels: usize) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    // Subsampled channels have fewer samples than pixels; they are left out.
    for channel in channels.list.into_iter().filter(|c| c.sample_data.len() == pixels) {
        let full = channel.name.to_string();
        let prefix = full.rsplit_once('.').map_or("", |(prefix, _)| prefix).to_owned();
        match groups.iter_mut().find(|(name, _)| *name == prefix) {
            Some((_, group)) => group.push(channel),
            None => groups.push((prefix, vec![channel])),
        }
    }
    groups
}

/// R, G and B (or X, Y and Z) of a group become a picture; any other channel becomes a grey one.
fn pictures_of_part(
    channels: AnyChannels<FlatSamples>,
    part: Option<&str>,
    (width, height): (u32, u32),
) -> Vec<Picture> {
    let mut pictures = Vec::new();
    for (prefix, group) in group_channels(channels, width as usize * height as usize) {
        let layer: Vec<&str> = part.into_iter().chain([prefix.as_str()]).filter(|s| !s.is_empty()).collect();
        let layer = layer.join(".");
        let picture = |name: String, channels: [usize; 3], is_colour: bool| {
            let data = interleave(channels.map(|i| &group[i].sample_data));
            Picture { name, image: RgbImage32 { width, height, data }, is_colour }
        };
        let find = |base: &str| group.iter().position(|c| base_name(c).eq_ignore_ascii_case(base));
        let triple = [["R", "G", "B"], ["X", "Y", "Z"]].into_iter().find_map(|names| {
            let [a, b, c] = names.map(find);
            Some([a?, b?, c?])
        });
        pictures.extend(triple.map(|triple| picture(layer.clone(), triple, true)));
        let used = |i: usize, base: &str| triple.is_some_and(|t| t.contains(&i) || base.eq_ignore_ascii_case("A"));
        for (i, base) in group.iter().map(base_name).enumerate().filter(|(i, base)| !used(*i, base)) {
            let is_luminance = base.eq_ignore_ascii_case("Y") && triple.is_none();
            let name = match (is_luminance, layer.is_empty()) {
                (true, _) => layer.clone(),
                (false, true) => base,
                (false, false) => format!("{layer}.{base}"),
            };
            pictures.push(picture(name, [i; 3], is_luminance));
        }
    }
    pictures
}

fn base_name(channel: &AnyChannel<FlatSamples>) -> String {
    let full = channel.name.to_string();
    full.rsplit_once('.').map_or(full.clone(), |(_, base)| base.to_owned())
}

fn interleave([r, g, b]: [&FlatSamples; 3]) -> Vec<[f32; 3]> {
    let pairs = r.values_as_f32().zip(g.values_as_f32()).zip(b.values_as_f32());
    pairs.map(|((r, g), b)| [r, g, b]).collect()
}

fn write(file: &ImageFile, _: Tone) -> Result<Vec<u8>, String> {
    let mut list = SmallVec::new();
    add_channels(&mut list, "", &file.image);
    for (name, image) in &file.layers {
        let wrong = |c: char| c.is_control() || !c.is_ascii();
        if name.is_empty() || name.contains(wrong) || file.layers.iter().filter(|(n, _)| n == name).count() > 1 {
            return Err(format!("`{name}` cannot name a layer: empty, not ASCII, or there twice"));
        }
        add_channels(&mut list, name, image);
    }
    let mut attributes = LayerAttributes { software_name: Some(text("sunfleck")), ..LayerAttributes::default() };
    for (name, value) in &file.metadata {
        if !name.is_ascii() {
            return Err(format!("`{name}` cannot name metadata: not ASCII"));
        }
        attributes.other.insert(text(&format!("{PREFIX}{name}")), AttributeValue::Text(text(value)));
    }
    let size = (file.image.width as usize, file.image.height as usize);
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(list));
    let mut bytes = Vec::new();
    Image::from_layer(layer).write().to_buffered(Cursor::new(&mut bytes)).map_err(|e| e.to_string())?;
    sort_attributes(&mut bytes);
    Ok(bytes)
}

/// In UTF-8: the format says nothing of encodings, and readers refuse files whose texts are something else.
fn text(value: &str) -> Text {
    Text::from_slice_unchecked(value.as_bytes())
}

fn add_channels(list: &mut SmallVec<[AnyChannel<FlatSamples>; 4]>, layer: &str, image: &RgbImage32) {
    for (i, base) in ["R", "G", "B"].into_iter().enumerate() {
        let name = if layer.is_empty() { base.to_owned() } else { format!("{layer}.{base}") };
        let samples = FlatSamples::F32(image.data.iter().map(|p| p[i]).collect());
        list.push(AnyChannel::new(name.as_str(), samples));
    }
}

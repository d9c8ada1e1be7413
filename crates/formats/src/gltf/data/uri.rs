//! What a `uri` points to: data in itself, or another file.

use data_url::DataUrl;
use percent_encoding::percent_decode_str;

/// A `uri`, taken apart.
pub(in super::super) enum Reference {
    /// Data, with their kind.
    Data { mime: String, bytes: Vec<u8> },
    /// The name of a file beside the scene.
    File(String),
    /// Something on a network, which is not fetched.
    Remote,
}

/// Takes a `uri` apart.
///
/// # Errors
/// Why it is none, or points to where no file can be.
pub(in super::super) fn reference(uri: &str) -> Result<Reference, String> {
    if uri.len() >= 5 && uri.as_bytes()[..5].eq_ignore_ascii_case(b"data:") {
        return data(uri);
    }
    if let Some((scheme, _)) = uri.split_once(':')
        && !scheme.contains(['/', '.', '?', '#'])
    {
        return if scheme.is_empty() {
            Err("a scheme is missing before `:`".to_owned())
        } else {
            Ok(Reference::Remote)
        };
    }
    Ok(Reference::File(percent_decode_str(uri).decode_utf8_lossy().into_owned()))
}

fn data(uri: &str) -> Result<Reference, String> {
    let url = DataUrl::process(uri).map_err(|e| format!("bad data: {e:?}"))?;
    let head = uri.split(',').next().unwrap_or_default();
    if head.contains(";;") {
        return Err("bad data: an empty parameter".to_owned());
    }
    let (bytes, _) = url.decode_to_vec().map_err(|_| "the data are not base64".to_owned())?;
    let mime = head[5..].split(';').next().unwrap_or_default().to_owned();
    Ok(Reference::Data { mime, bytes })
}

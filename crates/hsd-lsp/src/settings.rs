//! Settings of the client: `initializationOptions`, or the section `hsd` of its configuration.
//!
//! | key | meaning |
//! |---|---|
//! | `language` | `en`, `ja` or `auto`: that of the editor |
//! | `textures` | folders of part images, instead of that of the document and its `textures` subfolder |
//! | `catalogs` | files of custom parts |
//! | `parameters` | names and values of parameters |
//! | `seed` | overrides the random seeds of houses |
//! | `root` | the folder below which includes are allowed |
//! | `pictures` | whether cards contain images of parts; off by default, because terminals show them as text |
//! | `inlayHints` | whether lengths are shown after wall lines |

use hsd_base::diagnostic::Language;
use serde_json::Value;
use std::path::PathBuf;

/// The settings of a client.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Settings {
    /// The language of diagnostics and cards.
    pub(super) language: Language,
    /// Folders of part images; if empty, those of the document.
    pub(super) textures: Vec<PathBuf>,
    /// Files of custom parts.
    pub(super) catalogs: Vec<PathBuf>,
    /// Parameters and their values.
    pub(super) parameters: Vec<(String, String)>,
    /// Overrides the random seeds of houses.
    pub(super) seed: Option<u64>,
    /// The folder below which includes are allowed.
    pub(super) root: Option<PathBuf>,
    /// True if cards contain images.
    pub(super) pictures: bool,
    /// True if lengths are shown after wall lines.
    pub(super) inlay_hints: bool,
}

impl Settings {
    /// Returns the default settings.
    pub(super) fn new(language: Language) -> Settings {
        Settings {
            language,
            textures: vec![],
            catalogs: vec![],
            parameters: vec![],
            seed: None,
            root: None,
            pictures: false,
            inlay_hints: true,
        }
    }

    /// Parses settings; invalid values are ignored. Relative paths are resolved against the workspace folder.
    pub(super) fn read(values: &Value, locale: Language, folder: Option<&PathBuf>) -> Settings {
        let mut settings = Settings::new(match values["language"].as_str() {
            Some("en") => Language::English,
            Some("ja") => Language::Japanese,
            _ => locale,
        });
        let path = |v: &Value| {
            let path = v.as_str().filter(|p| !p.is_empty())?;
            Some(folder.map_or_else(|| PathBuf::from(path), |f| f.join(path)))
        };
        let paths = |key: &str| {
            let list = values[key].as_array().into_iter().flatten();
            list.filter_map(path).collect::<Vec<_>>()
        };
        settings.textures = paths("textures");
        settings.catalogs = paths("catalogs");
        settings.root = path(&values["root"]);
        let parameters = values["parameters"].as_object().into_iter().flatten();
        settings.parameters = parameters
            .map(|(name, value)| match value {
                Value::String(text) => (name.clone(), text.clone()),
                Value::Bool(truth) => (name.clone(), if *truth { "yes" } else { "no" }.to_owned()),
                other => (name.clone(), other.to_string()),
            })
            .collect();
        settings.seed = values["seed"].as_u64();
        settings.pictures = values["pictures"].as_bool().unwrap_or(false);
        settings.inlay_hints = values["inlayHints"].as_bool().unwrap_or(true);
        settings
    }
}

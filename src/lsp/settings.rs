//! What a client may wish: `initializationOptions`, or the section `hsd` of its settings.
//!
//! | key | meaning |
//! |---|---|
//! | `language` | `en`, `ja` or `auto`: that of the editor |
//! | `textures` | folders of part pictures, in place of the text's own and its `textures` |
//! | `catalogs` | files of own parts |
//! | `parameters` | names and values of parameters |
//! | `seed` | in place of the seeds of houses |
//! | `root` | the folder below which included files lie |
//! | `pictures` | whether cards show pictures of parts; unless said they do not, since terminals show a page of letters in their place |
//! | `inlayHints` | whether lengths are shown behind wall lines |

use crate::diagnostic::Language;
use serde_json::Value;
use std::path::PathBuf;

/// The wishes of a client.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Settings {
    /// Of messages and cards.
    pub(super) language: Language,
    /// Folders of part pictures; none = beside the text.
    pub(super) textures: Vec<PathBuf>,
    /// Files of own parts.
    pub(super) catalogs: Vec<PathBuf>,
    /// Parameters and their values.
    pub(super) parameters: Vec<(String, String)>,
    /// In place of the seeds of houses.
    pub(super) seed: Option<u64>,
    /// The folder below which included files lie.
    pub(super) root: Option<PathBuf>,
    /// Whether cards show pictures.
    pub(super) pictures: bool,
    /// Whether lengths are shown behind lines.
    pub(super) inlay_hints: bool,
}

impl Settings {
    /// What holds where nothing is said.
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

    /// Reads what is said; what makes no sense is passed over. Relative paths begin at the folder of the work.
    pub(super) fn read(said: &Value, locale: Language, folder: Option<&PathBuf>) -> Settings {
        let mut settings = Settings::new(match said["language"].as_str() {
            Some("en") => Language::English,
            Some("ja") => Language::Japanese,
            _ => locale,
        });
        let path = |v: &Value| {
            let path = v.as_str().filter(|p| !p.is_empty())?;
            Some(folder.map_or_else(|| PathBuf::from(path), |f| f.join(path)))
        };
        let paths = |key: &str| {
            let list = said[key].as_array().into_iter().flatten();
            list.filter_map(path).collect::<Vec<_>>()
        };
        settings.textures = paths("textures");
        settings.catalogs = paths("catalogs");
        settings.root = path(&said["root"]);
        let parameters = said["parameters"].as_object().into_iter().flatten();
        settings.parameters = parameters
            .map(|(name, value)| match value {
                Value::String(text) => (name.clone(), text.clone()),
                Value::Bool(truth) => (name.clone(), if *truth { "yes" } else { "no" }.to_owned()),
                other => (name.clone(), other.to_string()),
            })
            .collect();
        settings.seed = said["seed"].as_u64();
        settings.pictures = said["pictures"].as_bool().unwrap_or(false);
        settings.inlay_hints = said["inlayHints"].as_bool().unwrap_or(true);
        settings
    }
}

//! Towns in an editor: the fields of their maps are known, and their rules are checked at every feature.

use crate::lsp::client::{Client, position, range};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const TOWN: &str = r#"<Town name="hamlet" seed="1">
  <Param name="year" default="1928"/>
  <Layer name="houses" src="houses.geojson" crs="local" key="id">
    <Field name="levels" from="building:levels" type="number" default="2"/>
  </Layer>
  <Layer name="roads" src="roads.geojson" crs="local"/>
  <for each="houses" test="{area &lt; 20}"><Skip because="a shed"/></for>
  <for each="houses" test="{area &gt;= 20}">
    <if test="{use = 'shop'}"><Place type="so-nikai" front="roads"/></if>
    <else><Place type="hiraya"/></else>
  </for>
</Town>
"#;

/// A hamlet of houses: x, width and use of each.
fn houses(all: &[(u32, u32, &str)]) -> String {
    let feature = |(number, (x, width, kind)): (usize, &(u32, u32, &str))| {
        let (left, right) = (*x, x + width);
        format!(
            r#"{{"type":"Feature","properties":{{"id":"h{number}","use":"{kind}","building:levels":{number}}},
            "geometry":{{"type":"Polygon","coordinates":[[[{left},2],[{right},2],[{right},12],[{left},12],[{left},2]]]}}}}"#
        )
    };
    let features: Vec<String> = all.iter().enumerate().map(feature).collect();
    collection(&features.join(","))
}

fn collection(features: &str) -> String {
    format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#)
}

struct Hamlet {
    folder: TempDir,
    uri: String,
    client: Client,
    text: String,
    version: i32,
}

impl Hamlet {
    fn new() -> Hamlet {
        let folder = tempfile::tempdir().expect("can be made");
        let real = folder.path().canonicalize().expect("is there");
        let road = r#"{"type":"Feature","properties":{"highway":"residential"},
            "geometry":{"type":"LineString","coordinates":[[-20,-2],[80,-2]]}}"#;
        write(&real, "roads.geojson", &collection(road));
        let four = [
            (0, 6, "shop"),
            (8, 6, "home"),
            (16, 6, "shop"),
            (24, 1, "shed"),
        ];
        write(&real, "houses.geojson", &houses(&four));
        write(&real, "town.hsd", TOWN);
        let uri = format!("file://{}", real.join("town.hsd").display());
        let client = Client::start("utf-16");
        client.open(&uri, TOWN);
        let text = TOWN.to_owned();
        Hamlet {
            folder,
            uri,
            client,
            text,
            version: 1,
        }
    }

    fn diagnostics(&mut self) -> Vec<Value> {
        self.client.diagnostics(&self.uri, Some(self.version))
    }

    /// Changes the text; returns what is said of it.
    fn change(&mut self, from: &str, to: &str) -> Vec<Value> {
        assert!(self.text.contains(from), "{from}");
        self.text = self.text.replacen(from, to, 1);
        self.version += 1;
        let whole = json!([{ "text": self.text }]);
        self.client.change(&self.uri, self.version, whole);
        self.diagnostics()
    }

    /// The place in a stretch of the text that `|` marks.
    fn place(&self, marked: &str) -> Value {
        let (before, after) = marked.split_once('|').expect("is marked");
        let at = self.text.find(&[before, after].concat()).expect("is there");
        position(&self.text, at + before.len(), "utf-16")
    }

    fn ask(&mut self, method: &str, marked: &str) -> Value {
        let position = self.place(marked);
        let params = json!({ "textDocument": { "uri": self.uri }, "position": position });
        let answer = self
            .client
            .request(&format!("textDocument/{method}"), params);
        answer.expect("is answered")
    }

    fn hover(&mut self, marked: &str) -> String {
        let answer = self.ask("hover", marked);
        answer["contents"]["value"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    }

    /// The labels that are proposed, with what is said of each.
    fn completions(&mut self, marked: &str) -> Vec<(String, String)> {
        let answer = self.ask("completion", marked);
        let items = answer["items"].as_array().expect("is a list");
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        items
            .iter()
            .map(|i| (text(&i["label"]), text(&i["detail"])))
            .collect()
    }
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).expect("can be written");
}

fn find<'l>(list: &'l [(String, String)], label: &str) -> &'l str {
    let found = list.iter().find(|(l, _)| l == label);
    &found.unwrap_or_else(|| panic!("{label} in {list:?}")).1
}

#[test]
fn fields_of_the_maps_are_proposed_where_they_can_be_named() {
    let mut hamlet = Hamlet::new();
    assert_eq!(hamlet.diagnostics(), Vec::<Value>::new());
    let names = hamlet.completions("{us|e = 'shop'}");
    assert_eq!(
        find(&names, "use"),
        "texts, in 4 of 4 features: shop, home, shed"
    );
    let names = hamlet.completions("test=\"{|area &gt;= 20}");
    assert_eq!(
        find(&names, "levels"),
        "numbers, in 4 of 4 features: 0, 1, 2, 3"
    );
    assert_eq!(find(&names, "frontage"), "the length of its front, m");
    assert!(!find(&names, "year").is_empty());
    // In an expression no name has a colon; the `from` of a field may.
    assert!(names.iter().all(|(label, _)| label != "building:levels"));
    let fields = hamlet.completions("from=\"building|:levels\"");
    assert!(find(&fields, "building:levels").starts_with("numbers, in 4 of 4"));
    assert!(fields.iter().all(|(label, _)| label != "levels"));
    let layers = hamlet.completions("front=\"|roads\"");
    assert_eq!(find(&layers, "roads"), "a layer of 1 features");
    assert!(hamlet.client.finish());
}

#[test]
fn types_and_their_parameters_are_proposed() {
    let mut hamlet = Hamlet::new();
    hamlet.diagnostics();
    let types = hamlet.completions("type=\"|hiraya\"");
    assert!(find(&types, "so-nikai").contains("town house"), "{types:?}");
    hamlet.change("<Place type=\"hiraya\"/>", "<Place type=\"hiraya\" />");
    let parameters = hamlet.completions("type=\"hiraya\" |/>");
    assert!(
        parameters.iter().any(|(label, _)| label == "frontage"),
        "{parameters:?}"
    );
    assert!(hamlet.client.finish());
}

#[test]
fn hover_tells_of_fields_measures_and_how_many_features_a_test_takes() {
    let mut hamlet = Hamlet::new();
    hamlet.diagnostics();
    let told = hamlet.hover("{us|e = 'shop'}");
    assert_eq!(
        told,
        "**use** (`houses`)\n\ntexts, in 4 of 4 features: shop, home, shed"
    );
    let told = hamlet.hover("{ar|ea &lt; 20}");
    assert_eq!(told, "**area** (`houses`)\n\nof its outline, square metres");
    let told = hamlet.hover("{area &lt; |20}");
    assert!(
        told.ends_with("takes 1 of the 4 features of `houses`"),
        "{told}"
    );
    // An `if` is asked only where its `for` applies.
    let told = hamlet.hover("{use |= 'shop'}");
    let said = "takes 2 of 3 features at which it is asked, of 4 of `houses`";
    assert!(told.ends_with(said), "{told}");
    let told = hamlet.hover("from=\"building:|levels\"");
    assert!(told.starts_with("**building:levels**"), "{told}");
    assert!(hamlet.client.finish());
}

#[test]
fn a_misspelt_field_is_told_at_its_place_and_names_the_nearest() {
    let mut hamlet = Hamlet::new();
    hamlet.diagnostics();
    let found = hamlet.change("{use = 'shop'}", "{usse = 'shop'}");
    let [one] = &found[..] else {
        panic!("{found:?}");
    };
    let at = hamlet.text.find("usse").expect("is there");
    assert_eq!(one["range"], range(&hamlet.text, at..at + 4, "utf-16"));
    let message = one["message"].as_str().expect("is a text");
    assert!(message.contains("`use`"), "{message}");
    // Fields are known also while the text has errors.
    let names = hamlet.completions("{us|se = 'shop'}");
    assert!(find(&names, "use").contains("in 4 of 4"));
    let found = hamlet.change("{usse = 'shop'}", "{use = 'shop'}");
    assert_eq!(found, Vec::<Value>::new());
    assert!(hamlet.client.finish());
}

#[test]
fn a_map_that_changes_is_read_again() {
    let mut hamlet = Hamlet::new();
    hamlet.diagnostics();
    let path = hamlet.folder.path().canonicalize().expect("is there");
    let two = [(0, 6, "shop"), (8, 6, "inn")];
    write(&path, "houses.geojson", &houses(&two));
    let map = format!("file://{}", path.join("houses.geojson").display());
    let changes = json!({ "changes": [{ "uri": map, "type": 2 }] });
    hamlet
        .client
        .notify("workspace/didChangeWatchedFiles", changes);
    hamlet.diagnostics();
    let told = hamlet.hover("{us|e = 'shop'}");
    assert!(told.ends_with("in 2 of 2 features: shop, inn"), "{told}");
    fs::remove_file(path.join("houses.geojson")).expect("can be removed");
    let found = hamlet.change("hamlet", "village");
    assert!(
        found[0]["message"]
            .as_str()
            .expect("is a text")
            .contains("houses.geojson")
    );
    assert!(hamlet.client.finish());
}

#[test]
fn names_beside_references_are_renamed_too() {
    let mut hamlet = Hamlet::new();
    hamlet.diagnostics();
    hamlet.change("{area &lt; 20}", "{area &lt; 20 and year &lt; 2000}");
    let position = hamlet.place("name=\"ye|ar\"");
    let document = json!({ "uri": hamlet.uri });
    let params = json!({ "textDocument": document, "position": position, "newName": "date" });
    let edit = hamlet
        .client
        .request("textDocument/rename", params)
        .expect("is allowed");
    let edits = edit["documentChanges"][0]["edits"]
        .as_array()
        .expect("are there");
    let places: Vec<&Value> = edits.iter().map(|e| &e["range"]).collect();
    let used = hamlet.text.find("year &lt; 2000").expect("is there");
    assert_eq!(places.len(), 2, "{edits:?}");
    assert!(places.contains(&&range(&hamlet.text, used..used + 4, "utf-16")));
    assert!(hamlet.client.finish());
}

/// A file that comes into a folder of which a pattern of the town names the files.
#[test]
fn a_new_sheet_is_read() {
    let mut hamlet = Hamlet::new();
    hamlet.diagnostics();
    let found = hamlet.change("src=\"houses.geojson\"", "src=\"house*.geojson\"");
    assert_eq!(found, Vec::<Value>::new());
    let told = hamlet.hover("{us|e = 'shop'}");
    assert!(told.contains("in 4 of 4 features"), "{told}");
    let path = hamlet.folder.path().canonicalize().expect("is there");
    write(&path, "houses-2.geojson", &houses(&[(50, 6, "inn")]));
    let map = format!("file://{}", path.join("houses-2.geojson").display());
    let changes = json!({ "changes": [{ "uri": map, "type": 1 }] });
    hamlet
        .client
        .notify("workspace/didChangeWatchedFiles", changes);
    hamlet.diagnostics();
    let told = hamlet.hover("{us|e = 'shop'}");
    assert!(
        told.ends_with("in 5 of 5 features: inn, shop, home, shed"),
        "{told}"
    );
    // A file of a list that is not there is told at its place.
    let found = hamlet.change("house*.geojson", "houses.geojson, hoses.geojson");
    let at = hamlet.text.find("hoses.geojson").expect("is there");
    assert_eq!(
        found[0]["range"],
        range(&hamlet.text, at..at + 13, "utf-16")
    );
    assert!(hamlet.client.finish());
}

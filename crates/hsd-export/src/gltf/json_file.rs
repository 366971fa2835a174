//! The JSON and the buffer of a `.glb` in memory whose arrays have views of their own, as tables of features want them.

use crate::pieces::Pieces;
use glam::DVec3;
use serde_json::{Value, json};

/// The extension of packed views.
const MESHOPT: &str = "EXT_meshopt_compression";

/// The extension that puts a mesh up many times, and that which names the feature of each.
pub(super) const INSTANCES: [&str; 2] = ["EXT_mesh_gpu_instancing", "EXT_instance_features"];

/// Returns an accessor of a whole view.
pub(super) fn accessor(view: usize, component: u32, count: usize, kind: &str) -> Value {
    json!({ "bufferView": view, "componentType": component, "count": count, "type": kind })
}

/// The JSON of a file in the making.
pub(super) struct File {
    root: Value,
    views: Vec<Value>,
    accessors: Vec<Value>,
    /// The bytes of packed views once they are unpacked.
    pub(super) unpacked: usize,
}

impl File {
    /// Creates one without arrays.
    pub(super) fn new(root: Value) -> File {
        File {
            root,
            views: vec![],
            accessors: vec![],
            unpacked: 0,
        }
    }

    /// Adds a view of the buffer, which begins at a multiple of eight; with the stride and target of vertices or
    /// indices. A stride of 0 is none.
    pub(super) fn view(
        &mut self,
        bin: &mut Pieces,
        vertices: Option<(usize, u32)>,
        write: impl FnOnce(&mut Vec<u8>),
    ) -> usize {
        bin.pad(8);
        let start = bin.len();
        write(bin.end());
        self.listed(start, bin.len() - start, vertices)
    }

    /// As [`File::view`], of vertices or indices that are there in the bytes of the file.
    pub(super) fn array(
        &mut self,
        bin: &mut Pieces,
        vertices: (usize, u32),
        bytes: Vec<u8>,
    ) -> usize {
        bin.pad(8);
        let (start, length) = (bin.len(), bytes.len());
        bin.push(bytes);
        self.listed(start, length, Some(vertices))
    }

    fn listed(&mut self, start: usize, length: usize, vertices: Option<(usize, u32)>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": length });
        if let Some((stride, target)) = vertices {
            view["target"] = json!(target);
            if stride > 0 {
                view["byteStride"] = json!(stride);
            }
        }
        self.views.push(view);
        self.views.len() - 1
    }

    /// Adds a packed view, which readers unpack into a buffer without bytes; of vertices, or of indices.
    #[cfg(feature = "compress")]
    pub(super) fn packed_view(
        &mut self,
        bin: &mut Pieces,
        stream: &super::compress::streams::Stream,
        vertices: bool,
    ) -> usize {
        let bytes = stream.packed();
        bin.pad(8);
        let extension = stream.extension(bin.len(), bytes.len());
        bin.push(bytes);
        let mut view = json!({
            "buffer": 1, "byteOffset": self.unpacked, "byteLength": stream.length(),
            "target": if vertices { 34962 } else { 34963 },
            "extensions": { MESHOPT: extension },
        });
        if vertices {
            view["byteStride"] = json!(stream.stride());
        }
        self.unpacked += stream.length().next_multiple_of(8);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Adds an accessor; returns its number.
    pub(super) fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds meshes, their nodes with the extensions of those, and the extensions of the file.
    pub(super) fn finish(
        &mut self,
        bin: &mut Pieces,
        meshes: Vec<(Value, Value)>,
        table: Value,
        centre: DVec3,
    ) {
        bin.pad(4);
        let root = &mut self.root;
        root["accessors"] = json!(self.accessors);
        root["bufferViews"] = json!(self.views);
        let mut buffers = vec![json!({ "byteLength": bin.len() })];
        if self.unpacked > 0 {
            let fallback = json!({ MESHOPT: { "fallback": true } });
            buffers.push(json!({ "byteLength": self.unpacked, "extensions": fallback }));
        }
        root["buffers"] = json!(buffers);
        let instanced = meshes.iter().any(|(_, extensions)| !extensions.is_null());
        let nodes = meshes.iter().enumerate().map(|(mesh, (_, extensions))| {
            let mut node =
                json!({ "mesh": mesh, "translation": [centre.x, centre.z, 0.0 - centre.y] });
            if !extensions.is_null() {
                node["extensions"] = extensions.clone();
            }
            node
        });
        root["nodes"] = nodes.collect();
        root["scenes"] = json!([{ "nodes": (0..meshes.len()).collect::<Vec<_>>() }]);
        root["meshes"] = meshes.into_iter().map(|(mesh, _)| mesh).collect();
        root["scene"] = json!(0);
        let mut used = root["extensionsUsed"]
            .as_array()
            .cloned()
            .unwrap_or_default();
        let packed = (self.unpacked > 0).then_some(MESHOPT);
        let [instances, of_instances] = INSTANCES;
        let needed: Vec<&str> = ["KHR_mesh_quantization"]
            .into_iter()
            .chain(packed)
            .chain(instanced.then_some(instances))
            .collect();
        let own = ["EXT_mesh_features", "EXT_structural_metadata"];
        used.extend(instanced.then(|| Value::from(of_instances)));
        used.extend(
            own.into_iter()
                .chain(needed.iter().copied())
                .map(Value::from),
        );
        root["extensionsUsed"] = json!(used);
        let mut required = root["extensionsRequired"].as_array().cloned();
        required
            .get_or_insert_default()
            .extend(needed.into_iter().map(Value::from));
        root["extensionsRequired"] = json!(required);
        root["extensions"]["EXT_structural_metadata"] = table;
    }

    /// Puts JSON and buffer into a container.
    pub(super) fn packed(&self, bin: Pieces) -> Pieces {
        let mut json = serde_json::to_vec(&self.root).unwrap_or_default();
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + json.len() + 8 + bin.len();
        let mut head = b"glTF".to_vec();
        for number in [2, length as u32, json.len() as u32] {
            head.extend(number.to_le_bytes());
        }
        head.extend(b"JSON");
        head.extend(json);
        head.extend((bin.len() as u32).to_le_bytes());
        head.extend(b"BIN\0");
        bin.behind(head)
    }
}

// Browser side of cesium.mjs: loads a tileset with CesiumJS, near enough that every level is wanted.
window.CESIUM_BASE_URL = '/node_modules/cesium/Build/Cesium/';
const { Cesium3DTileset, CesiumWidget, HeadingPitchRange } = await import('/node_modules/cesium/Build/Cesium/index.js');

/** How long a town may take, milliseconds. */
const PATIENCE = 60_000;

document.body.innerHTML = '<div id="globe" style="width: 160px; height: 120px"></div>';
// Nothing but the town: images of the earth, its terrain and the stars would come from elsewhere. Nothing that only makes it
// look better, which takes long in software.
const widget = new CesiumWidget('globe', {
  baseLayer: false, globe: false, skyBox: false, skyAtmosphere: false, showRenderLoopErrors: false, msaaSamples: 1,
  creditContainer: document.createElement('div'),
});

/** Loads all of a tileset; returns what was named and drawn. */
window.visit = async url => {
  const errors = [], names = new Set(), { scene, camera } = widget;
  scene.renderError.addEventListener((_, error) => errors.push(`${error}`));
  // So little is small enough that every tile is replaced by the nearest level.
  const tileset = await Cesium3DTileset.fromUrl(url, {
    maximumScreenSpaceError: 0, dynamicScreenSpaceError: false, foveatedScreenSpaceError: false, environmentMapOptions: { enabled: false },
  });
  tileset.tileFailed.addEventListener(({ url, message }) => errors.push(`${url}: ${message}`));
  tileset.tileLoad.addEventListener(({ content }) => {
    for (let i = 0; i < content.featuresLength; i++) names.add(content.getFeature(i).getProperty('key'));
  });
  scene.primitives.add(tileset);
  camera.viewBoundingSphere(tileset.boundingSphere, new HeadingPitchRange(0.3, -0.4, tileset.boundingSphere.radius * 2.2));
  const loaded = new Promise(done => tileset.allTilesLoaded.addEventListener(done));
  const late = new Promise(done => setTimeout(() => { errors.push('not all of it is loaded'); done(); }, PATIENCE));
  await Promise.race([loaded, late]);
  let triangles = 0;
  const drawn = ({ content }) => { triangles += content.trianglesLength; };
  tileset.tileVisible.addEventListener(drawn);
  scene.preRender.addEventListener(() => { triangles = 0; });
  await new Promise(done => scene.postRender.addEventListener(done));
  names.delete(undefined);
  return { errors, features: names.size, triangles };
};
window.ready = true;

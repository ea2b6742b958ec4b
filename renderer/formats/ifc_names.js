// SPDX-License-Identifier: GPL-3.0-or-later
// What an IFC file calls its elements: styles and materials, storeys, presentation layers.

class Names extends Measures {
  readStyles() {
    this.styleOf = new Map();
    for (const item of this.lines('IfcStyledItem')) {
      const name = (item.Styles || []).map((style) => this.styleName(style)).find(Boolean);
      if (item.Item && name) this.styleOf.set(item.Item.value, name);
    }
    this.materialOf = new Map();
    for (const relation of this.lines('IfcRelAssociatesMaterial')) {
      const name = this.materialName(relation.RelatingMaterial);
      for (const object of name ? relation.RelatedObjects || [] : []) this.materialOf.set(object.value, name);
    }
    for (const relation of this.lines('IfcRelDefinesByType')) {
      const name = relation.RelatingType && this.materialOf.get(relation.RelatingType.value);
      for (const object of name ? relation.RelatedObjects || [] : []) {
        if (!this.materialOf.has(object.value)) this.materialOf.set(object.value, name);
      }
    }
  }
  styleName(reference) {
    const style = reference && reference.value ? this.line(reference.value) : {};
    return style.Styles && !style.Name ? style.Styles.map((s) => this.styleName(s)).find(Boolean) : valueOf(style.Name);
  }
  // Of a material, or of a set of layers, profiles or constituents: its own name, else those within it.
  materialName(reference, depth = 0) {
    if (!reference || !reference.value || depth > 4) return '';
    const line = this.line(reference.value);
    const own = valueOf(line.LayerSetName) || (depth === 0 || !line.Material ? valueOf(line.Name) : '');
    if (own) return own;
    const within = [line.ForLayerSet, line.ForProfileSet, line.Material].filter(Boolean)
      .concat(line.MaterialLayers || [], line.MaterialProfiles || [], line.MaterialConstituents || [], line.Materials || []);
    return [...new Set(within.map((item) => this.materialName(item, depth + 1)).filter(Boolean))].join(' + ');
  }
  // Each image of a style, [kind, reason] -> count: web-ifc's triangles have no place for it.
  texturesByName() {
    const styleOf = new Map();
    for (const style of this.lines('IfcSurfaceStyle')) {
      for (const part of style.Styles || []) {
        for (const texture of (part && part.value && this.line(part.value).Textures) || []) styleOf.set(texture.value, valueOf(style.Name) || '');
      }
    }
    const found = new Map();
    for (const kind of ['IfcImageTexture', 'IfcBlobTexture', 'IfcPixelTexture']) {
      for (const id of this.ids(kind)) {
        const {URLReference, UrlReference} = this.line(id);
        const image = kind === 'IfcImageTexture' ? String(valueOf(URLReference || UrlReference)) : 'an image within the file';
        const style = styleOf.has(id) ? ' of style "' + styleOf.get(id) + '"' : '';
        const what = JSON.stringify([kind, image + style + ': its colour alone is shown, give it the image in materials.json']);
        found.set(what, (found.get(what) || 0) + 1);
      }
    }
    return found;
  }

  // Element -> "storey", "storey/layer" or "layer".
  readPlaces() {
    this.parentOf = new Map();
    for (const [type, whole, parts] of [['IfcRelContainedInSpatialStructure', 'RelatingStructure', 'RelatedElements'],
      ['IfcRelAggregates', 'RelatingObject', 'RelatedObjects'], ['IfcRelNests', 'RelatingObject', 'RelatedObjects']]) {
      for (const relation of this.lines(type)) {
        for (const part of relation[whole] ? relation[parts] || [] : []) this.parentOf.set(part.value, relation[whole].value);
      }
    }
    this.storeyName = new Map(this.ids('IfcBuildingStorey').map((id) => {
      const storey = this.line(id);
      return [id, valueOf(storey.LongName) && !valueOf(storey.Name) ? valueOf(storey.LongName) : valueOf(storey.Name) || ''];
    }));
    this.layerOf = new Map();
    for (const type of ['IfcPresentationLayerAssignment', 'IfcPresentationLayerWithStyle']) {
      for (const layer of this.lines(type)) {
        for (const item of layer.AssignedItems || []) this.layerOf.set(item.value, valueOf(layer.Name) || '');
      }
    }
  }
  placeOf(element, item) {
    let storey = '';
    for (let id = element, i = 0; id !== undefined && i < 100 && !storey; id = this.parentOf.get(id), ++i) {
      storey = this.storeyName.get(id) || '';
    }
    const layer = this.layerOf.get(item) || this.shapesOf(element).map((id) => this.layerOf.get(id)).find(Boolean) || '';
    return [storey, layer].filter(Boolean).join('/');
  }
  // Ids of its representations.
  shapesOf(element) {
    const shape = this.line(element).Representation;
    return shape && shape.value ? (this.line(shape.value).Representations || []).map((one) => one.value) : [];
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The units of an IFC file, and where it says that its model stands.

class Georeference extends Names {
  // One that says what it is.
  hasLengthUnit() {
    const units = this.lines('IfcUnitAssignment').flatMap((one) => one.Units || []).map((unit) => this.line(unit.value));
    const length = units.find((unit) => valueOf(unit.UnitType) === 'LENGTHUNIT');
    if (length && length.constructor.name.startsWith('IfcContextDependentUnit')) {
      this.warnings.push('its unit of length is called "' + valueOf(length.Name) + '" and not defined');
      return false;
    }
    return length !== undefined;
  }
  // Of the project's units, else of any of the kind.
  unitOf(type, power) {
    const assigned = this.lines('IfcUnitAssignment').flatMap((one) => one.Units || []).map((one) => this.line(one.value));
    for (const unit of [...assigned, ...this.lines('IfcSIUnit'), ...this.lines('IfcConversionBasedUnit')]) {
      if (valueOf(unit.UnitType) === type) return this.metresOf(unit, power) || 1;
    }
    return 1;
  }
  metresOf(unit, power = 1) {
    const prefixes = {MICRO: 1e-6, MILLI: 1e-3, CENTI: 1e-2, DECI: 1e-1, DECA: 10, HECTO: 100, KILO: 1e3};
    const factor = unit.ConversionFactor && this.line(unit.ConversionFactor.value);
    if (!factor) return (prefixes[valueOf(unit.Prefix)] || 1) ** power;
    const base = factor.UnitComponent ? this.metresOf(this.line(factor.UnitComponent.value), power) : 1;
    return (Number(valueOf(factor.ValueComponent)) || 1) * base;
  }
  // Of a unit of length that is defined by another that is itself defined by one (feet by inches by millimetres), web-ifc
  // reads the first step: the factor that it misses.
  missedUnit() {
    const assigned = this.lines('IfcUnitAssignment').flatMap((one) => one.Units || []).map((one) => this.line(one.value));
    const length = assigned.find((unit) => valueOf(unit.UnitType) === 'LENGTHUNIT');
    const factor = length && length.ConversionFactor && this.line(length.ConversionFactor.value);
    const base = factor && factor.UnitComponent ? this.line(factor.UnitComponent.value) : {};
    return base.ConversionFactor ? this.metresOf(base) : 1;
  }
  // Where the file says the model stands: applied if placement.json says so.
  readMapConversion() {
    const values = [...this.lines('IfcMapConversion'), ...this.lines('IfcMapConversionScaled'), ...this.rigidOperations(),
      ...this.mapProperties()];
    const crs = this.lines('IfcProjectedCRS');
    const system = crs.map((one) => valueOf(one.Name)).find(Boolean);
    for (const map of values.slice(0, 1)) {
      const number = (name) => Number(valueOf(map[name]) || 0);
      const turn = Math.atan2(number('XAxisOrdinate'), Number(valueOf(map.XAxisAbscissa) ?? 1)) * 180 / Math.PI;
      const [unit, scale] = this.mapUnitAndScale(map, crs);
      const shift = ['Eastings', 'Northings', 'OrthogonalHeight'].map((name) => number(name) * unit);
      this.map = {rotation_deg: Number(turn.toFixed(9)), shift, scale};
      this.warnings.push('holds map coordinates' + (system ? ' (' + system + ')' : '') +
        ' that are not applied: to use them write {"map_conversion": true} into placement.json, which is {"rotation_deg": ' +
        this.map.rotation_deg + ', "shift": [' + shift.join(', ') + ']' + (scale === 1 ? '' : ', "scale": ' + scale) + '}');
    }
    if (values.length > 0) return;
    for (const site of this.lines('IfcSite')) {
      const degrees = (angle) => {
        const parts = valueOf(angle);
        return Array.isArray(parts) ? parts.reduce((sum, part, i) => sum + Number(valueOf(part)) / [1, 60, 3600, 3.6e9][i], 0) : null;
      };
      const [latitude, longitude] = [degrees(site.RefLatitude), degrees(site.RefLongitude)];
      if (latitude === null || longitude === null) continue;
      this.warnings.push('its site is at latitude ' + latitude.toFixed(6) + ', longitude ' + longitude.toFixed(6) +
        ', which is not applied: place the model by placement.json');
    }
  }
  // Metres of a map's unit, and how many times larger the model is on the map. What exporters write where units differ is
  // a thousand times off either way; a map is never.
  mapUnitAndScale(map, crs) {
    const project = this.unitOf('LENGTHUNIT', 1);
    const stated = crs.map((one) => one.MapUnit && this.metresOf(this.line(one.MapUnit.value))).find(Boolean);
    const factor = Number(valueOf(map.Scale) || 1);
    const isUnit = Math.abs(factor / project - 1) < 0.01 && Math.abs(project - 1) > 0.01;
    const unit = stated || (isUnit ? 1 : project);
    const scale = factor * unit / project;
    const isNear = (value) => Math.abs(value - 1) < 0.01;
    return [unit, isNear(scale) ? scale : isNear(factor) ? factor : 1];
  }
  // Of IFC4x3: a shift alone, in metres as it says, or in degrees, which are no place for a model.
  rigidOperations() {
    return this.lines('IfcRigidOperation').filter((one) => (one.FirstCoordinate || {}).name === 'IFCLENGTHMEASURE')
      .map((one) => ({Eastings: one.FirstCoordinate, Northings: one.SecondCoordinate, OrthogonalHeight: one.Height}));
  }
  mapProperties() {
    return this.lines('IfcPropertySet')
      .filter((set) => /^e?pset_mapconversion$/i.test(String(valueOf(set.Name))))
      .map((set) => Object.fromEntries((set.HasProperties || []).map((reference) => {
        const property = this.line(reference.value);
        return [valueOf(property.Name), valueOf(property.NominalValue)];
      })));
  }
}

// Position of the sun, after NOAA's solar calculator (Meeus, Astronomical Algorithms), accurate to about 0.01 degrees for
// several centuries around the present; includes atmospheric refraction.

const RAD = Math.PI / 180;
const sin = (degrees: number) => Math.sin(degrees * RAD), cos = (degrees: number) => Math.cos(degrees * RAD);
const tan = (degrees: number) => Math.tan(degrees * RAD);

/** Degrees, longitude positive to the east; zone: hours ahead of UTC. */
export interface Place {
  latitude: number;
  longitude: number;
  zone: number;
}

export const KYOTO: Place = { latitude: 35.01, longitude: 135.77, zone: 9 };

/** Degrees: azimuth from north towards east, altitude above the horizon. */
export interface Sun {
  azimuth: number;
  altitude: number;
}

/** Julian day at 0 h UTC of a date in the Gregorian calendar. */
export function julianDay(year: number, month: number, day: number): number {
  if (month <= 2) { year -= 1; month += 12; }
  const century = Math.floor(year / 100);
  return Math.floor(365.25 * (year + 4716)) + Math.floor(30.6001 * (month + 1)) + day + 2 - century
    + Math.floor(century / 4) - 1524.5;
}

/** The sun's position at a date and local clock time, in hours from 0 to 24. */
export function sunPosition(date: { year: number; month: number; day: number }, hour: number, place: Place): Sun {
  const day = julianDay(date.year, date.month, date.day) + (hour - place.zone) / 24;
  const t = (day - 2451545) / 36525; // Julian centuries since 2000
  const long = (280.46646 + t * (36000.76983 + t * 0.0003032)) % 360; // mean longitude
  const anomaly = 357.52911 + t * (35999.05029 - 0.0001537 * t);
  const e = 0.016708634 - t * (0.000042037 + 0.0000001267 * t); // eccentricity of the earth's orbit
  const centre = sin(anomaly) * (1.914602 - t * (0.004817 + 0.000014 * t)) + sin(2 * anomaly) * (0.019993 - 0.000101 * t)
    + sin(3 * anomaly) * 0.000289;
  const node = 125.04 - 1934.136 * t;
  const apparent = long + centre - 0.00569 - 0.00478 * sin(node);
  const tilt = 23 + (26 + (21.448 - t * (46.815 + t * (0.00059 - t * 0.001813))) / 60) / 60 + 0.00256 * cos(node);
  const declination = Math.asin(sin(tilt) * sin(apparent)) / RAD;
  const y = tan(tilt / 2) ** 2;
  const equation = 4 / RAD * (y * sin(2 * long) - 2 * e * sin(anomaly) + 4 * e * y * sin(anomaly) * cos(2 * long)
    - y * y * sin(4 * long) / 2 - 1.25 * e * e * sin(2 * anomaly)); // equation of time, minutes
  const minutes = hour * 60 + equation + 4 * place.longitude - 60 * place.zone;
  const turn = minutes / 4 - 180; // hour angle, 0 at noon
  const { latitude } = place;
  const height = Math.asin(sin(latitude) * sin(declination) + cos(latitude) * cos(declination) * cos(turn)) / RAD;
  const azimuth = Math.atan2(sin(turn), cos(turn) * sin(latitude) - tan(declination) * cos(latitude)) / RAD + 180;
  return { azimuth: (azimuth + 360) % 360, altitude: height + refraction(height) };
}

/** Atmospheric refraction, degrees. */
function refraction(altitude: number): number {
  const h = altitude;
  if (h > 85) return 0;
  if (h > 5) return (58.1 / tan(h) - 0.07 / tan(h) ** 3 + 0.000086 / tan(h) ** 5) / 3600;
  if (h > -0.575) return (1735 + h * (-518.2 + h * (103.4 + h * (-12.79 + h * 0.711)))) / 3600;
  return -20.774 / tan(h) / 3600;
}

/** Unit vector to the sun in the page's frame: x east, y up, z south. */
export function sunDirection({ azimuth, altitude }: Sun): [x: number, y: number, z: number] {
  return [sin(azimuth) * cos(altitude), sin(altitude), -cos(azimuth) * cos(altitude)];
}

/** Parses `2026-06-21`; null if it is not a date. */
export function parseDate(text: string): { year: number; month: number; day: number } | null {
  const [year, month, day] = text.split('-').map(Number);
  return year && month && day ? { year, month, day } : null;
}

/** Formats 9.25 as `9:15`. */
export function formatHour(hour: number): string {
  const minutes = Math.round(hour * 60);
  return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, '0')}`;
}

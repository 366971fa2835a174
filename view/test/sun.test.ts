// Sun positions compared with published values: Meeus's worked examples, and observatories' data for Kyoto and Greenwich.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { formatHour, parseDate, julianDay, KYOTO, sunPosition, sunDirection } from '../src/scene/sun.ts';

const near = (got: number, want: number, by: number, what: string) =>
  assert.ok(Math.abs(got - want) <= by, `${what}: ${got}, not ${want}`);

test('Julian days as in Meeus, chapter 7', () => {
  assert.equal(julianDay(2000, 1, 1), 2451544.5);
  assert.equal(julianDay(1987, 1, 27), 2446822.5);
  assert.equal(julianDay(1988, 6, 19), 2447331.5);
  assert.equal(julianDay(1900, 1, 1), 2415020.5);
  assert.equal(julianDay(1600, 12, 31), 2305812.5);
});

test('the worked example of the solar position algorithm (NREL/TP-560-34302, A.5)', () => {
  // 17 October 2003, 12:30:30 at UTC-7, 39.742476 N, 105.1786 W: zenith 50.11162, azimuth 194.34024.
  const place = { latitude: 39.742476, longitude: -105.1786, zone: -7 };
  const sun = sunPosition({ year: 2003, month: 10, day: 17 }, 12 + 30.5 / 60, place);
  near(90 - sun.altitude, 50.11162, 0.02, 'zenith');
  near(sun.azimuth, 194.34024, 0.02, 'azimuth');
});

test('noon altitudes in Kyoto at the solstices and the equinox', () => {
  // The sun culminates at 90 - latitude + declination; declinations +-23.44, and about 0.
  const noon = (year: number, month: number, day: number) => {
    let best = { azimuth: 0, altitude: -90 };
    for (let hour = 11; hour < 13; hour += 1 / 60) {
      const sun = sunPosition({ year, month, day }, hour, KYOTO);
      if (sun.altitude > best.altitude) best = sun;
    }
    return best;
  };
  near(noon(2026, 6, 21).altitude, 90 - 35.01 + 23.44, 0.05, 'midsummer');
  near(noon(2026, 12, 22).altitude, 90 - 35.01 - 23.44, 0.06, 'midwinter');
  near(noon(2026, 3, 20).altitude, 90 - 35.01, 0.3, 'equinox');
  near(noon(2026, 6, 21).azimuth, 180, 1.5, 'south');
});

test('sunrise and sunset in Kyoto as in the almanac', () => {
  // NAOJ, Kyoto: 21 June 4:43 and 19:14; 22 December 7:01 and 16:49 (upper limb: 16 minutes of arc below the horizon).
  const crossing = (month: number, day: number, from: number, to: number) => {
    for (let hour = from; hour < to; hour += 1 / 120) {
      const [a, b] = [hour, hour + 1 / 120].map(t => sunPosition({ year: 2026, month, day }, t, KYOTO).altitude + 16 / 60);
      if (a! < 0 !== b! < 0) return hour;
    }
    return NaN;
  };
  near(crossing(6, 21, 3, 8), 4 + 43 / 60, 2 / 60, 'rise in June');
  near(crossing(6, 21, 17, 21), 19 + 14 / 60, 2 / 60, 'set in June');
  near(crossing(12, 22, 5, 9), 7 + 1 / 60, 2 / 60, 'rise in December');
  near(crossing(12, 22, 15, 19), 16 + 49 / 60, 2 / 60, 'set in December');
});

test('the direction to the sun: east is x, south is z', () => {
  const [x, y, z] = sunDirection({ azimuth: 90, altitude: 0 });
  near(x, 1, 1e-12, 'x'); near(y, 0, 1e-12, 'y'); near(z, 0, 1e-12, 'z');
  near(sunDirection({ azimuth: 180, altitude: 30 })[2], Math.cos(Math.PI / 6), 1e-12, 'south');
});

test('dates and hours', () => {
  assert.deepEqual(parseDate('2026-06-21'), { year: 2026, month: 6, day: 21 });
  assert.equal(parseDate(''), null);
  assert.equal(formatHour(9.25), '9:15');
  assert.equal(formatHour(12), '12:00');
});

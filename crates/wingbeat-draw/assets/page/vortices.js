// Vorticity on a grid, and the surfaces on which its size has a level. Runs in a worker, or in the
// page where there is none; knows nothing of the page.
//
// Points carry (x, y, z, wx, wy, wz, share, youth): place, vorticity times volume, share of the
// downstroke, youth from 1 (new) to 0. Each is spread as a Gaussian of width sigma, without regard to its
// youth: the level is that of the true vorticity.
const CUT = 2.6; // Gaussians end at so many sigma
function spread(points, { h, sigma, low, high, most }) {
  const n = points.length / 8, reach = Math.ceil(CUT * sigma / h), span = 2 * reach + 1;
  let from = [Infinity, Infinity, Infinity], to = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < n; i++) for (let c = 0; c < 3; c++) {
    const x = Math.max(low[c], Math.min(high[c], points[8 * i + c]));
    if (x < from[c]) from[c] = x;
    if (x > to[c]) to[c] = x;
  }
  const pad = (reach + 2) * h;
  from = from.map((x) => x - pad);
  const size = from.map((x, c) => Math.max(4, Math.min(most, Math.ceil((to[c] + pad - x) / h) + 1)));
  const cells = size[0] * size[1] * size[2], sums = new Float32Array(6 * cells);
  const norm = 1 / (Math.pow(2 * Math.PI, 1.5) * sigma ** 3), inverse = 1 / (2 * sigma * sigma);
  const gauss = [new Float32Array(span), new Float32Array(span), new Float32Array(span)];
  for (let i = 0; i < n; i++) {
    const o = 8 * i, place = [0, 1, 2].map((c) => (points[o + c] - from[c]) / h), first = place.map((x) => Math.round(x) - reach);
    if (first.some((x, c) => x < 0 || x + span >= size[c])) continue;
    const wx = points[o + 3] * norm, wy = points[o + 4] * norm, wz = points[o + 5] * norm, weight = Math.hypot(wx, wy, wz), share = points[o + 6], youth = points[o + 7];
    if (!(weight > 0)) continue;
    for (let c = 0; c < 3; c++) for (let k = 0; k < span; k++) { const e = (first[c] + k - place[c]) * h; gauss[c][k] = Math.exp(-e * e * inverse); }
    for (let c = 0; c < span; c++) for (let b = 0; b < span; b++) {
      const g = gauss[1][b] * gauss[2][c];
      if (g < 0.02) continue;
      let q = 6 * (((first[2] + c) * size[1] + first[1] + b) * size[0] + first[0]);
      for (let a = 0; a < span; a++, q += 6) {
        const w = g * gauss[0][a], u = w * weight;
        sums[q] += w * wx; sums[q + 1] += w * wy; sums[q + 2] += w * wz;
        sums[q + 3] += u; sums[q + 4] += u * share; sums[q + 5] += u * youth;
      }
    }
  }
  const field = { size, from, h, curl: new Float32Array(cells), weight: new Float32Array(cells), share: new Float32Array(cells), youth: new Float32Array(cells), most: 0 };
  for (let i = 0, q = 0; i < cells; i++, q += 6) {
    const curl = Math.sqrt(sums[q] * sums[q] + sums[q + 1] * sums[q + 1] + sums[q + 2] * sums[q + 2]);
    field.curl[i] = curl; field.weight[i] = sums[q + 3]; field.share[i] = sums[q + 4]; field.youth[i] = sums[q + 5];
    if (curl > field.most) field.most = curl;
  }
  return field;
}

const EDGES = [[0, 1], [0, 2], [0, 4], [1, 3], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 6], [5, 7], [6, 7]];
// Naive surface nets: one vertex in every cell the surface passes, at the mean of its crossings of edges.
function surface(field, level, least) {
  const { size: [nx, ny, nz], from, h, curl } = field, sy = nx, sz = nx * ny;
  const corners = [0, 1, sy, sy + 1, sz, sz + 1, sz + sy, sz + sy + 1], id = new Int32Array(nx * ny * nz).fill(-1), v = new Float64Array(8), w = new Float64Array(8);
  const places = [], normals = [], shares = [], youths = [], faces = [];
  const face = (a, b, c, d, flip) => {
    if (a < 0 || b < 0 || c < 0 || d < 0) return;
    if (flip) faces.push(a, c, b, a, d, c); else faces.push(a, b, c, a, c, d);
  };
  for (let z = 1; z < nz - 2; z++) for (let y = 1; y < ny - 2; y++) for (let x = 1; x < nx - 2; x++) {
    const q = z * sz + y * sy + x;
    let mask = 0;
    for (let k = 0; k < 8; k++) if (curl[q + corners[k]] > level) mask |= 1 << k;
    if (mask === 0 || mask === 255) continue;
    for (let k = 0; k < 8; k++) v[k] = curl[q + corners[k]] - level;
    let px = 0, py = 0, pz = 0, n = 0;
    for (const [a, b] of EDGES) if ((mask >> a & 1) !== (mask >> b & 1)) {
      const t = v[a] / (v[a] - v[b]);
      px += (a & 1) + t * ((b & 1) - (a & 1)); py += (a >> 1 & 1) + t * ((b >> 1 & 1) - (a >> 1 & 1)); pz += (a >> 2) + t * ((b >> 2) - (a >> 2)); n++;
    }
    px /= n; py /= n; pz /= n;
    for (let k = 0; k < 8; k++) w[k] = ((k & 1) ? px : 1 - px) * ((k >> 1 & 1) ? py : 1 - py) * ((k >> 2) ? pz : 1 - pz);
    const at = (list) => { let r = 0; for (let k = 0; k < 8; k++) r += w[k] * list[q + corners[k]]; return r; };
    const slope = (s) => { let r = 0; for (let k = 0; k < 8; k++) r += w[k] * (curl[q + corners[k] - s] - curl[q + corners[k] + s]); return r; };
    id[q] = places.length / 3;
    places.push(from[0] + (x + px) * h, from[1] + (y + py) * h, from[2] + (z + pz) * h);
    const gx = slope(1), gy = slope(sy), gz = slope(sz), size = Math.hypot(gx, gy, gz) || 1, weight = at(field.weight);
    normals.push(gx / size, gy / size, gz / size);
    shares.push(weight > 0 ? at(field.share) / weight : 0.5);
    youths.push(weight > 0 ? Math.min(1, 1.25 * at(field.youth) / weight) : 0);
    if ((mask & 1) !== (mask >> 1 & 1)) face(id[q], id[q - sy], id[q - sy - sz], id[q - sz], mask & 1);
    if ((mask & 1) !== (mask >> 2 & 1)) face(id[q], id[q - sz], id[q - sz - 1], id[q - 1], mask & 1);
    if ((mask & 1) !== (mask >> 4 & 1)) face(id[q], id[q - 1], id[q - 1 - sy], id[q - sy], mask & 1);
  }
  return { places: new Float32Array(places), normals: new Float32Array(normals), shares: new Float32Array(shares), youths: new Float32Array(youths), faces: new Uint32Array(withoutCrumbs(faces, youths, least)) };
}
// Faces of the connected pieces that are large and young enough to be looked at.
function withoutCrumbs(faces, youths, least) {
  const n = youths.length, parent = new Int32Array(n).map((_, i) => i), count = new Int32Array(n), youth = new Float32Array(n);
  const root = (a) => { while (parent[a] !== a) a = parent[a] = parent[parent[a]]; return a; };
  for (let i = 0; i < faces.length; i += 3) { const a = root(faces[i]); parent[root(faces[i + 1])] = a; parent[root(faces[i + 2])] = a; }
  for (let i = 0; i < n; i++) { const a = root(i); count[a]++; youth[a] += youths[i]; }
  const kept = [];
  for (let i = 0; i < faces.length; i += 3) { const a = root(faces[i]); if (count[a] >= least && youth[a] / count[a] > 0.06) kept.push(faces[i], faces[i + 1], faces[i + 2]); }
  return kept;
}
// What is asked of the worker: points, grid, levels; answers two surfaces.
function vortices({ points, grid, levels, least }) {
  const field = spread(points, grid);
  return { surfaces: levels.map((level, k) => surface(field, level, least[k])), most: field.most };
}

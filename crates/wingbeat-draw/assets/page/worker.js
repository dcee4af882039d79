onmessage = ({ data }) => {
  const begun = performance.now(), { surfaces, most } = vortices(data);
  postMessage({ id: data.id, surfaces, most, took: performance.now() - begun }, surfaces.flatMap((s) => [s.places.buffer, s.normals.buffer, s.shares.buffer, s.youths.buffer, s.faces.buffer]));
};

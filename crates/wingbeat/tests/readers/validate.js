// Validates a glTF file with the Khronos validator: node validate.js FOLDER FILE, where FOLDER
// holds node_modules. Prints its statistics; any error or warning ends it with an error.
const [folder, file] = process.argv.slice(2);
const validator = require(require("path").join(folder, "node_modules", "gltf-validator"));
const bytes = new Uint8Array(require("fs").readFileSync(file));
validator.validateBytes(bytes).then((report) => {
  console.log(JSON.stringify({ ...report.info, issues: report.issues }));
  process.exit(report.issues.numErrors + report.issues.numWarnings > 0 || report.info.animationCount !== 1 ? 1 : 0);
});

import { loadKernel } from "./kernel.js";

const kernel = await loadKernel(import.meta.url);
kernel.make_numbers(2, 1, 4096);
kernel.prepare(0, 0, 0, kernel.best_method(0, 0), 0.3, 0.6, 0.6, 0, 0.8, 0, 0, 1);
kernel.draw(0, 4096);
const kept = kernel.draws[0].pdf.subarray(0, 4096).filter((pdf) => pdf > 0).length;
document.getElementById("status").textContent = `lobe ${kernel.text(kernel.version())}: ${kept} of 4096 draws leave`;

/* libdraco behind gltf_draco.h. No exception leaves this file. */
#include "gltf_draco.h"

#include <cstdlib>
#include <memory>

#include <draco/compression/decode.h>

namespace {

/* Greatest number of vertices or triangles that is believed. */
constexpr std::size_t count_max = std::size_t{1} << 28;

bool copy_indices(const draco::Mesh &mesh, gltf_arrays &arrays) {
    arrays.index_count = 3 * std::size_t{mesh.num_faces()};
    arrays.indices = static_cast<uint32_t *>(std::calloc(arrays.index_count + 1, sizeof(uint32_t)));
    if (!arrays.indices) return false;
    for (uint32_t f = 0; f < mesh.num_faces(); f++)
        for (uint32_t k = 0; k < 3; k++)
            arrays.indices[3 * std::size_t{f} + k] =
                mesh.face(draco::FaceIndex(f))[static_cast<int>(k)].value();
    return true;
}

bool copy_values(const draco::Mesh &mesh, const draco::PointAttribute &attribute, int channels,
                 float *values) {
    for (uint32_t i = 0; i < mesh.num_points(); i++) {
        const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
        float *value = values + std::size_t{i} * static_cast<std::size_t>(channels);
        if (index.value() >= attribute.size()) return false;
        const auto kept = static_cast<int8_t>(
            attribute.num_components() < channels ? attribute.num_components() : channels);
        if (!attribute.ConvertValue<float>(index, kept, value)) return false;
        for (int c = kept; c < channels; c++) value[c] = c == 3 ? 1.0F : 0.0F;
    }
    return true;
}

bool decode(gltf_bytes packed, const int *ids, gltf_arrays &arrays) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char *>(packed.data), packed.size);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return false;
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    if (!mesh || mesh->num_points() > count_max || mesh->num_faces() > count_max) return false;
    arrays.vertex_count = mesh->num_points();
    if (!copy_indices(*mesh, arrays)) return false;
    for (int s = 0; s < GLTF_SEMANTICS; s++) {
        if (ids[s] < 0) continue;
        const draco::PointAttribute *attribute =
            mesh->GetAttributeByUniqueId(static_cast<uint32_t>(ids[s]));
        if (!attribute) return false;
        const int channels = lobe_gltf_channels[s];
        arrays.values[s] = static_cast<float *>(std::calloc(
            arrays.vertex_count * static_cast<std::size_t>(channels) + 1, sizeof(float)));
        if (!arrays.values[s] || !copy_values(*mesh, *attribute, channels, arrays.values[s]))
            return false;
    }
    return true;
}

} // namespace

int lobe_gltf_draco_decode(gltf_bytes packed, const int ids[GLTF_SEMANTICS], gltf_arrays *arrays) {
    try {
        return decode(packed, ids, *arrays) ? 1 : 0;
    } catch (...) {
        return 0;
    }
}

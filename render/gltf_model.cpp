/* tinygltf behind the plain structures of gltf_model.h. No exception leaves this file. */
#include "gltf_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <tiny_gltf.h>

namespace {

/* ---- Files beside, and pictures ---------------------------------------------------------------- */

bool is_regular(const std::string &path) {
    struct stat status;
    return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

bool file_exists(const std::string &path, void *) {
    return is_regular(path);
}

std::string leave_path(const std::string &path, void *) {
    return path;
}

bool read_file(std::vector<unsigned char> *bytes, std::string *error, const std::string &path,
               void *) {
    std::FILE *file = is_regular(path) ? std::fopen(path.c_str(), "rb") : nullptr;
    if (!file) {
        *error += path + " cannot be opened";
        return false;
    }
    std::array<unsigned char, 65536> part;
    for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), file)) > 0;)
        bytes->insert(bytes->end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(n));
    std::fclose(file);
    return true;
}

bool write_nothing(std::string *, const std::string &, const std::vector<unsigned char> &, void *) {
    return false;
}

/* Pictures are kept as they are. What a view holds is looked at later: tinygltf checks no bounds
 * before it calls this. */
bool keep_picture(tinygltf::Image *image, const int, std::string *, std::string *, int, int,
                  const unsigned char *bytes, int size, void *) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

/* ---- Values of extensions ---------------------------------------------------------------------- */

using tinygltf::Value;

const Value *find(const tinygltf::ExtensionMap &extensions, const char *name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

const Value *member(const Value *object, const char *name) {
    return object && object->IsObject() && object->Has(name) ? &object->Get(name) : nullptr;
}

double number(const Value *object, const char *name, double fallback) {
    const Value *value = member(object, name);
    return value && value->IsNumber() ? value->GetNumberAsDouble() : fallback;
}

int integer(const Value *object, const char *name, int fallback) {
    const double value = number(object, name, fallback);
    return value >= -1.0 && value <= 2147483647.0 ? static_cast<int>(value) : fallback;
}

/* 0 for what is no size at all. */
std::size_t size_of(const Value *object, const char *name) {
    const double value = number(object, name, 0.0);
    return value >= 0.0 && value < 9007199254740992.0 ? static_cast<std::size_t>(value) : 0;
}

std::string text(const Value *object, const char *name) {
    const Value *value = member(object, name);
    return value && value->IsString() ? value->Get<std::string>() : std::string();
}

void numbers(const Value *object, const char *name, double *values, std::size_t count) {
    const Value *array = member(object, name);
    if (!array || array->ArrayLen() != count) return;
    for (std::size_t i = 0; i < count; i++) {
        const Value &value = array->Get(static_cast<int>(i));
        if (value.IsNumber()) values[i] = value.GetNumberAsDouble();
    }
}

void copy(const std::vector<double> &from, double *to, std::size_t count) {
    if (from.size() == count) std::copy(from.begin(), from.end(), to);
}

/* ---- The parts of a model ---------------------------------------------------------------------- */

gltf_view plain(const tinygltf::BufferView &v) {
    gltf_view view = {};
    view.buffer = v.buffer;
    view.offset = v.byteOffset;
    view.length = v.byteLength;
    view.stride = v.byteStride;
    const Value *packed = find(v.extensions, "EXT_meshopt_compression");
    if (!packed) return view;
    const std::string mode = text(packed, "mode"), filter = text(packed, "filter");
    view.packing = mode == "TRIANGLES" ? GLTF_TRIANGLES
                   : mode == "INDICES" ? GLTF_INDICES
                                       : GLTF_ATTRIBUTES;
    view.filter = filter.empty() || filter == "NONE" ? GLTF_FILTER_NONE
                  : filter == "OCTAHEDRAL"           ? GLTF_FILTER_OCTAHEDRAL
                  : filter == "QUATERNION"           ? GLTF_FILTER_QUATERNION
                  : filter == "EXPONENTIAL"          ? GLTF_FILTER_EXPONENTIAL
                                                     : GLTF_FILTER_UNKNOWN;
    view.buffer = integer(packed, "buffer", -1);
    view.offset = size_of(packed, "byteOffset");
    view.length = size_of(packed, "byteLength");
    view.stride = size_of(packed, "byteStride");
    view.count = size_of(packed, "count");
    return view;
}

/* Offsets that are negative become too large for any view. */
std::size_t offset_of(int offset) {
    return offset < 0 ? SIZE_MAX : static_cast<std::size_t>(offset);
}

gltf_accessor plain(const tinygltf::Accessor &a) {
    gltf_accessor accessor = {};
    accessor.view = a.bufferView;
    accessor.component = a.componentType;
    accessor.channels = a.type == TINYGLTF_TYPE_SCALAR ? 1
                        : a.type == TINYGLTF_TYPE_VEC2 ? 2
                        : a.type == TINYGLTF_TYPE_VEC3 ? 3
                        : a.type == TINYGLTF_TYPE_VEC4 ? 4
                        : a.type == TINYGLTF_TYPE_MAT4 ? 16
                                                       : 0;
    accessor.offset = a.byteOffset;
    accessor.count = a.count;
    accessor.is_normalized = a.normalized;
    accessor.greatest = a.maxValues.empty() ? 0.0 : a.maxValues[0];
    accessor.is_sparse = a.sparse.isSparse;
    if (!a.sparse.isSparse) return accessor;
    accessor.sparse_count = offset_of(a.sparse.count);
    accessor.index_view = a.sparse.indices.bufferView;
    accessor.index_component = a.sparse.indices.componentType;
    accessor.index_offset = offset_of(a.sparse.indices.byteOffset);
    accessor.value_view = a.sparse.values.bufferView;
    accessor.value_offset = offset_of(a.sparse.values.byteOffset);
    return accessor;
}

std::string semantic_name(int semantic) {
    static const char *const names[] = {"POSITION", "NORMAL", "TANGENT", "COLOR_0"};
    if (semantic < GLTF_TEXCOORD) return names[semantic];
    if (semantic < GLTF_JOINTS) return "TEXCOORD_" + std::to_string(semantic - GLTF_TEXCOORD);
    return semantic < GLTF_WEIGHTS ? "JOINTS_" + std::to_string(semantic - GLTF_JOINTS)
                                   : "WEIGHTS_" + std::to_string(semantic - GLTF_WEIGHTS);
}

int find_accessor(const std::map<std::string, int> &attributes, const std::string &name) {
    const auto found = attributes.find(name);
    return found != attributes.end() ? found->second : -1;
}

gltf_target plain(const std::map<std::string, int> &attributes) {
    gltf_target target = {};
    for (int s = 0; s < GLTF_MORPHED; s++)
        target.accessors[s] = find_accessor(attributes, semantic_name(s));
    return target;
}

/* Attributes that nobody reads; those of an application, with an underscore, are none of ours. */
bool has_more(const tinygltf::Primitive &p) {
    const auto is_known = [](const std::string &name, int count) {
        for (int s = 0; s < count; s++)
            if (semantic_name(s) == name) return true;
        return name.empty() || name[0] == '_';
    };
    for (const auto &attribute : p.attributes)
        if (!is_known(attribute.first, GLTF_SEMANTICS)) return true;
    for (const auto &target : p.targets)
        for (const auto &attribute : target)
            if (!is_known(attribute.first, GLTF_MORPHED)) return true;
    return false;
}

gltf_primitive plain(const tinygltf::Primitive &p) {
    gltf_primitive primitive = {};
    primitive.indices = p.indices;
    primitive.material = p.material;
    primitive.mode = p.mode;
    primitive.has_more = has_more(p);
    const Value *draco = find(p.extensions, "KHR_draco_mesh_compression");
    const Value *attributes = member(draco, "attributes");
    primitive.draco_view = draco ? std::max(integer(draco, "bufferView", -1), -1) : -1;
    for (int s = 0; s < GLTF_SEMANTICS; s++) {
        const std::string name = semantic_name(s);
        primitive.accessors[s] = find_accessor(p.attributes, name);
        primitive.draco_ids[s] = integer(attributes, name.c_str(), -1);
    }
    return primitive;
}

gltf_node plain(const tinygltf::Node &n) {
    gltf_node node = {};
    node.name = n.name.c_str();
    node.mesh = n.mesh;
    node.camera = n.camera;
    node.skin = n.skin;
    node.light = integer(find(n.extensions, "KHR_lights_punctual"), "light", -1);
    node.children = n.children.data();
    node.child_count = n.children.size();
    node.has_matrix = n.matrix.size() == 16;
    node.rotation[3] = 1.0;
    std::fill(node.scale, node.scale + 3, 1.0);
    copy(n.matrix, node.matrix, 16);
    copy(n.translation, node.translation, 3);
    copy(n.rotation, node.rotation, 4);
    copy(n.scale, node.scale, 3);
    node.weights = n.weights.data();
    node.weight_count = n.weights.size();
    const Value *instances = find(n.extensions, "EXT_mesh_gpu_instancing");
    const Value *attributes = member(instances, "attributes");
    node.is_instanced = instances != nullptr;
    node.instances[GLTF_TRANSLATION] = integer(attributes, "TRANSLATION", -1);
    node.instances[GLTF_ROTATION] = integer(attributes, "ROTATION", -1);
    node.instances[GLTF_SCALE] = integer(attributes, "SCALE", -1);
    return node;
}

gltf_skin plain(const tinygltf::Skin &s) {
    return {s.inverseBindMatrices, s.joints.data(), s.joints.size()};
}

gltf_channel plain(const tinygltf::AnimationChannel &c,
                   const std::vector<tinygltf::AnimationSampler> &samplers) {
    gltf_channel channel = {};
    channel.node = c.target_node;
    channel.path = c.target_path == "translation" ? GLTF_TRANSLATION
                   : c.target_path == "rotation"  ? GLTF_ROTATION
                   : c.target_path == "scale"     ? GLTF_SCALE
                   : c.target_path == "weights"   ? GLTF_MORPH
                                                  : GLTF_NO_PATH;
    channel.input = channel.output = -1;
    if (c.sampler < 0 || static_cast<std::size_t>(c.sampler) >= samplers.size()) return channel;
    const tinygltf::AnimationSampler &sampler = samplers[static_cast<std::size_t>(c.sampler)];
    channel.input = sampler.input;
    channel.output = sampler.output;
    channel.interpolation = sampler.interpolation == "STEP"          ? GLTF_STEP
                            : sampler.interpolation == "CUBICSPLINE" ? GLTF_CUBIC
                                                                     : GLTF_LINEAR;
    return channel;
}

gltf_texture_use use_of(int index, int uv_set, const Value *transform) {
    gltf_texture_use use = {};
    use.texture = index;
    use.uv_set = integer(transform, "texCoord", uv_set);
    use.scale[0] = use.scale[1] = 1.0;
    use.rotation = number(transform, "rotation", 0.0);
    numbers(transform, "offset", use.offset, 2);
    numbers(transform, "scale", use.scale, 2);
    return use;
}

template <typename Info> gltf_texture_use use_of(const Info &info) {
    return use_of(info.index, info.texCoord, find(info.extensions, "KHR_texture_transform"));
}

gltf_texture_use use_of(const Value *info) {
    if (!info) return use_of(-1, 0, nullptr);
    return use_of(integer(info, "index", -1), integer(info, "texCoord", 0),
                  member(member(info, "extensions"), "KHR_texture_transform"));
}

gltf_material plain(const tinygltf::Material &m) {
    gltf_material material = {};
    material.name = m.name.c_str();
    copy(m.pbrMetallicRoughness.baseColorFactor, material.base_color, 4);
    material.metallic = m.pbrMetallicRoughness.metallicFactor;
    material.roughness = m.pbrMetallicRoughness.roughnessFactor;
    copy(m.emissiveFactor, material.emission, 3);
    material.emissive_strength =
        number(find(m.extensions, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
    material.normal_scale = m.normalTexture.scale;
    material.alpha_cutoff = m.alphaCutoff;
    material.alpha = m.alphaMode == "MASK"    ? GLTF_MASK
                     : m.alphaMode == "BLEND" ? GLTF_BLEND
                                              : GLTF_OPAQUE;
    material.is_unlit = m.extensions.count("KHR_materials_unlit") != 0;
    const Value *anisotropy = find(m.extensions, "KHR_materials_anisotropy");
    material.anisotropy = number(anisotropy, "anisotropyStrength", 0.0);
    material.anisotropy_rotation = number(anisotropy, "anisotropyRotation", 0.0);
    material.anisotropic = use_of(member(anisotropy, "anisotropyTexture"));
    const Value *clearcoat = find(m.extensions, "KHR_materials_clearcoat");
    material.clearcoat = number(clearcoat, "clearcoatFactor", 0.0);
    material.clearcoat_roughness = number(clearcoat, "clearcoatRoughnessFactor", 0.0);
    const Value *clearcoat_normal = member(clearcoat, "clearcoatNormalTexture");
    material.clearcoat_normal_scale = number(clearcoat_normal, "scale", 1.0);
    material.clearcoat_share = use_of(member(clearcoat, "clearcoatTexture"));
    material.clearcoat_rough = use_of(member(clearcoat, "clearcoatRoughnessTexture"));
    material.clearcoat_normal = use_of(clearcoat_normal);
    const Value *specular = find(m.extensions, "KHR_materials_specular");
    material.specular = number(specular, "specularFactor", 1.0);
    std::fill(material.specular_color, material.specular_color + 3, 1.0);
    numbers(specular, "specularColorFactor", material.specular_color, 3);
    material.specular_share = use_of(member(specular, "specularTexture"));
    material.specular_tint = use_of(member(specular, "specularColorTexture"));
    const Value *transmission = find(m.extensions, "KHR_materials_transmission");
    material.transmission = number(transmission, "transmissionFactor", 0.0);
    material.transmissive = use_of(member(transmission, "transmissionTexture"));
    material.ior = number(find(m.extensions, "KHR_materials_ior"), "ior", 1.5);
    const Value *volume = find(m.extensions, "KHR_materials_volume");
    material.thickness = number(volume, "thicknessFactor", 0.0);
    material.attenuation_distance = number(volume, "attenuationDistance", HUGE_VAL);
    std::fill(material.attenuation_color, material.attenuation_color + 3, 1.0);
    numbers(volume, "attenuationColor", material.attenuation_color, 3);
    material.base = use_of(m.pbrMetallicRoughness.baseColorTexture);
    material.surface = use_of(m.pbrMetallicRoughness.metallicRoughnessTexture);
    material.normal = use_of(m.normalTexture);
    material.emissive = use_of(m.emissiveTexture);
    return material;
}

gltf_texture plain(const tinygltf::Texture &t, const std::vector<tinygltf::Sampler> &samplers) {
    gltf_texture texture = {t.source, GLTF_REPEAT, GLTF_REPEAT, -1, -1};
    if (t.sampler < 0 || static_cast<std::size_t>(t.sampler) >= samplers.size()) return texture;
    const tinygltf::Sampler &sampler = samplers[static_cast<std::size_t>(t.sampler)];
    texture.wrap_u = sampler.wrapS;
    texture.wrap_v = sampler.wrapT;
    texture.filter = sampler.magFilter;
    texture.small_filter = sampler.minFilter;
    return texture;
}

gltf_image plain(const tinygltf::Image &i) {
    return {i.name.c_str(), i.uri.c_str(), i.bufferView, {i.image.data(), i.image.size()}};
}

gltf_camera plain(const tinygltf::Camera &c) {
    return {c.name.c_str(), c.type == "perspective", c.perspective.yfov};
}

gltf_light plain(const tinygltf::Light &l) {
    gltf_light light = {};
    light.name = l.name.c_str();
    light.kind = l.type == "point"         ? GLTF_LIGHT_POINT
                 : l.type == "spot"        ? GLTF_LIGHT_SPOT
                 : l.type == "directional" ? GLTF_LIGHT_DIRECTIONAL
                                           : GLTF_LIGHT_UNKNOWN;
    std::fill(light.color, light.color + 3, 1.0);
    copy(l.color, light.color, 3);
    light.intensity = l.intensity;
    light.range = l.range;
    light.inner_angle = l.spot.innerConeAngle;
    light.outer_angle = l.spot.outerConeAngle;
    return light;
}

/* ---- The whole --------------------------------------------------------------------------------- */

/* What the plain structures point into. */
struct document : gltf_model {
    tinygltf::Model source;
    std::vector<gltf_bytes> all_buffers;
    std::vector<gltf_view> all_views;
    std::vector<gltf_accessor> all_accessors;
    std::vector<std::vector<gltf_target>> all_targets;
    std::vector<std::vector<gltf_primitive>> all_primitives;
    std::vector<std::vector<gltf_channel>> all_channels;
    std::vector<gltf_mesh> all_meshes;
    std::vector<gltf_node> all_nodes;
    std::vector<gltf_material> all_materials;
    std::vector<gltf_texture> all_textures;
    std::vector<gltf_image> all_images;
    std::vector<gltf_camera> all_cameras;
    std::vector<gltf_light> all_lights;
    std::vector<gltf_skin> all_skins;
    std::vector<gltf_animation> all_animations;
    std::vector<const char *> all_extensions, all_required;
    std::vector<int> all_roots;
};

template <typename From, typename To>
void convert(const std::vector<From> &from, std::vector<To> &to, const To *&array,
             std::size_t &count) {
    for (const From &item : from) to.push_back(plain(item));
    array = to.data();
    count = to.size();
}

/* The default scene, else the first; without any, the nodes that are nobody's children. */
void find_roots(document &d) {
    const tinygltf::Model &m = d.source;
    if (!m.scenes.empty()) {
        const auto index = static_cast<std::size_t>(std::max(m.defaultScene, 0));
        d.all_roots = m.scenes[index < m.scenes.size() ? index : 0].nodes;
    } else {
        std::vector<char> is_child(m.nodes.size());
        for (const tinygltf::Node &node : m.nodes)
            for (const int child : node.children)
                if (child >= 0 && static_cast<std::size_t>(child) < m.nodes.size())
                    is_child[static_cast<std::size_t>(child)] = 1;
        for (std::size_t i = 0; i < m.nodes.size(); i++)
            if (!is_child[i]) d.all_roots.push_back(static_cast<int>(i));
    }
    d.roots = d.all_roots.data();
    d.root_count = d.all_roots.size();
}

void describe_meshes(document &d) {
    for (const tinygltf::Mesh &mesh : d.source.meshes) {
        std::vector<gltf_primitive> primitives;
        for (const tinygltf::Primitive &p : mesh.primitives) {
            std::vector<gltf_target> targets;
            for (const auto &target : p.targets) targets.push_back(plain(target));
            d.all_targets.push_back(std::move(targets));
            primitives.push_back(plain(p));
            primitives.back().targets = d.all_targets.back().data();
            primitives.back().target_count = d.all_targets.back().size();
        }
        d.all_primitives.push_back(std::move(primitives));
        d.all_meshes.push_back({mesh.name.c_str(), d.all_primitives.back().data(),
                                d.all_primitives.back().size(), mesh.weights.data(),
                                mesh.weights.size()});
    }
    d.meshes = d.all_meshes.data();
    d.mesh_count = d.all_meshes.size();
}

void describe_animations(document &d) {
    for (const tinygltf::Animation &a : d.source.animations) {
        std::vector<gltf_channel> channels;
        for (const tinygltf::AnimationChannel &c : a.channels)
            channels.push_back(plain(c, a.samplers));
        d.all_channels.push_back(std::move(channels));
        d.all_animations.push_back(
            {a.name.c_str(), d.all_channels.back().data(), d.all_channels.back().size()});
    }
    d.animations = d.all_animations.data();
    d.animation_count = d.all_animations.size();
}

void describe(document &d) {
    const tinygltf::Model &m = d.source;
    for (const tinygltf::Buffer &b : m.buffers)
        d.all_buffers.push_back({b.data.data(), b.data.size()});
    d.buffers = d.all_buffers.data();
    d.buffer_count = d.all_buffers.size();
    describe_meshes(d);
    describe_animations(d);
    for (const tinygltf::Texture &t : m.textures) d.all_textures.push_back(plain(t, m.samplers));
    d.textures = d.all_textures.data();
    d.texture_count = d.all_textures.size();
    for (const std::string &name : m.extensionsUsed) d.all_extensions.push_back(name.c_str());
    d.extensions = d.all_extensions.data();
    d.extension_count = d.all_extensions.size();
    for (const std::string &name : m.extensionsRequired) d.all_required.push_back(name.c_str());
    d.required = d.all_required.data();
    d.required_count = d.all_required.size();
    convert(m.bufferViews, d.all_views, d.views, d.view_count);
    convert(m.accessors, d.all_accessors, d.accessors, d.accessor_count);
    convert(m.nodes, d.all_nodes, d.nodes, d.node_count);
    convert(m.materials, d.all_materials, d.materials, d.material_count);
    convert(m.images, d.all_images, d.images, d.image_count);
    convert(m.cameras, d.all_cameras, d.cameras, d.camera_count);
    convert(m.lights, d.all_lights, d.lights, d.light_count);
    convert(m.skins, d.all_skins, d.skins, d.skin_count);
    find_roots(d);
}

/* tinygltf ends its messages with a line end, or joins several. */
std::string one_line(const std::string &message) {
    std::string line;
    for (const char c : message)
        if (c != '\n')
            line += c;
        else if (line.empty() || line.back() != ' ')
            line += ' ';
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line.empty() ? "not understood" : line;
}

/* Empty: it is read. */
std::string read(document &d, const unsigned char *glb, std::size_t size, const char *folder) {
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keep_picture, nullptr);
    reader.SetFsCallbacks({file_exists, leave_path, read_file, write_nothing, nullptr});
    std::string error, warning;
    if (!reader.LoadBinaryFromMemory(&d.source, &error, &warning, glb, static_cast<unsigned>(size),
                                     folder))
        return one_line(error.empty() ? warning : error);
    describe(d);
    return std::string();
}

} // namespace

gltf_model *lobe_gltf_model_read(const unsigned char *glb, size_t size, const char *folder,
                                 char *message, size_t message_size) {
    document *d = nullptr;
    const char *why = "out of memory";
    std::string error;
    try {
        d = new document();
        error = read(*d, glb, size, folder);
        if (error.empty()) return d;
        why = error.c_str();
    } catch (const std::exception &e) {
        std::snprintf(message, message_size, "%s", e.what());
        delete d;
        return nullptr;
    } catch (...) {
    }
    std::snprintf(message, message_size, "%s", why);
    delete d;
    return nullptr;
}

void lobe_gltf_model_free(gltf_model *model) {
    delete static_cast<document *>(model);
}

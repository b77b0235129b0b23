// translucent.cpp: a sheet of paper, in C++: part of the light is reflected, part passes, both
// diffusely. Directions fill the whole sphere.
//
//     c++ -std=c++17 -O2 -fPIC -shared -I include examples/plugin/translucent.cpp -o translucent.so
//     lobe verify --plugin ./translucent.so
#include <lobe/plugin.h>

#include <cmath>
#include <limits>

namespace {

constexpr double pi = 3.14159265358979323846;

// The surface is written as a class, as it would stand in a renderer; in single precision.
class Sheet {
  public:
    explicit Sheet(const lobe_plugin_block *block)
        : side_(block->wi[2] < 0 ? -1.0F : 1.0F),
          reflected_(static_cast<float>(block->parameter[0])),
          passed_(static_cast<float>(block->parameter[1])) {}

    // A share of the draws that fits the share of the light.
    float reflection_probability() const {
        const float sum = reflected_ + passed_;
        return sum > 0 ? reflected_ / sum : 0.5F;
    }

    float density(float z) const {
        const float p = z * side_ > 0 ? reflection_probability() : 1 - reflection_probability();
        return p * std::fabs(z) / static_cast<float>(pi);
    }

    float value(float z) const {
        return (z * side_ > 0 ? reflected_ : passed_) * std::fabs(z) / static_cast<float>(pi);
    }

    lobe_plugin_draw draw(float u1, float u2, float u3) const {
        const float radius = std::sqrt(u1);
        const float angle = static_cast<float>(2 * pi) * u2;
        const bool is_reflected = u3 < reflection_probability();
        const float z = std::sqrt(1 - u1) * (is_reflected ? side_ : -side_);
        const float pdf = density(z);
        const float weight = pdf > 0 ? value(z) / pdf : 0;
        return {{radius * std::cos(angle), radius * std::sin(angle), z}, pdf, weight};
    }

  private:
    float side_, reflected_, passed_;
};

void sample(const lobe_plugin_block *block, const double u[3], lobe_plugin_draw *draw) {
    *draw = Sheet(block).draw(static_cast<float>(u[0]), static_cast<float>(u[1]),
                              static_cast<float>(u[2]));
}

double density(const lobe_plugin_block *block, const double wo[3]) {
    return Sheet(block).density(static_cast<float>(wo[2]));
}

double value(const lobe_plugin_block *block, const double wo[3]) {
    return Sheet(block).value(static_cast<float>(wo[2]));
}

double albedo(const lobe_plugin_block *block) {
    return block->parameter[0] + block->parameter[1];
}

lobe_plugin describe() {
    lobe_plugin plugin{};
    plugin.version = LOBE_PLUGIN_VERSION;
    plugin.name = "translucent";
    plugin.sample = sample;
    plugin.density = density;
    plugin.value = value;
    plugin.parameter_count = 2;
    plugin.parameter[0] = {"reflected", 0, 0.5, 0.4, 0, 0, {}};
    plugin.parameter[1] = {"passed", 0, 0.5, 0.2, 0, 0, {}};
    plugin.flags = LOBE_PLUGIN_SPHERE | LOBE_PLUGIN_RECIPROCAL;
    plugin.rounding = std::numeric_limits<float>::epsilon();
    plugin.weight_bound = 1;
    plugin.albedo = albedo;
    return plugin;
}

} // namespace

LOBE_PLUGIN_EXPORT const lobe_plugin *lobe_plugin_describe() {
    static const lobe_plugin plugin = describe();
    return &plugin;
}

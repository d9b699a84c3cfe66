// SPDX-License-Identifier: Apache-2.0
// What twin_requests.py asks of Python, asked in C++ by the public headers: the same requests of the same arrays.
// Loaded by ctypes into the same process, so that both find the same memory, threads and caches.
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "hogel/compress.h"
#include "hogel/files.h"
#include "hogel/pattern.h"
#include "hogel/pipeline.h"

namespace {

using namespace hogel;
using Complex = std::complex<float>;

std::shared_ptr<Field> field;
std::shared_ptr<LightFieldBuffer> buffer;

double sum_of(const float* values, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += std::abs(values[i]);
    return sum;
}
double sum_of(const Field& f) { return sum_of(reinterpret_cast<const float*>(f.samples.data()), 2 * f.samples.size()); }

Field loaded(const FieldSource& source) {
    Field result(source.grid());
    copy(source, result);
    return result;
}

Camera camera() {
    Camera camera = camera_for(buffer->grid().width(), buffer->grid().height(), 300);
    camera.eye = {10e-3, 0, 300e-3};
    camera.pupil = 20e-3;
    return camera;
}

HologramRequest request() {
    HologramRequest request;
    request.channels = {{532e-9, 1}};
    request.pitch = field->grid().plane.pitch_x;
    return request;
}

PatternOptions pattern() {
    const Grid& plane = field->grid().plane;
    PatternOptions options;
    options.encoding = Encoding::double_phase;
    options.modulator = {"own", plane.width, plane.height, plane.pitch_x, 256};
    return options;
}

// Does the work; the sum of what came of it is taken only if `tell`.
using Request = std::function<double(const std::string& path, bool tell)>;

double told(bool tell, const Field& f) { return tell ? sum_of(f) : 0; }
double told(bool tell, const Image& i) { return tell ? sum_of(i.pixels.data(), i.pixels.size()) : 0; }

const std::map<std::string, Request> requests = {
    {"propagate", [](const std::string&, bool tell) { return told(tell, propagate(*field, 2e-3)); }},
    {"load a field", [](const std::string&, bool tell) { return told(tell, loaded(*field)); }},
    {"save a hologram",
     [](const std::string& path, bool) {
         write_holograms(path, {field}, {});
         return 0.0;
     }},
    {"read a hologram", [](const std::string& path, bool tell) { return told(tell, loaded(*open_hologram(path)[0])); }},
    {"photograph by waves",
     [](const std::string&, bool tell) {
         const Camera view = camera();
         return told(tell, photograph_colours({field}, {&view, 1})[0]);
     }},
    {"pattern",
     [](const std::string&, bool tell) {
         const Pattern made = encode_pattern(*field, pattern());
         double sum = 0;
         if (tell)
             for (std::size_t i = 0; i < made.levels.size(); ++i) sum += made.levels.data()[i];
         return sum;
     }},
    {"photograph by rays",
     [](const std::string&, bool tell) {
         const Camera view = camera();
         return told(tell, photograph(LightField(buffer), {&view, 1})[0]);
     }},
    {"hologram", [](const std::string&,
                    bool tell) { return told(tell, loaded(*make_holograms(LightField(buffer), request())[0])); }},
    {"load a light field",
     [](const std::string&, bool tell) {
         LightFieldBuffer copied(buffer->grid());
         copy(*buffer, copied);
         return tell ? sum_of(copied.radiance.data(), copied.radiance.size()) : 0;
     }},
    {"save a light field",
     [](const std::string& path, bool) {
         LightFieldFileOptions options;
         options.type = SampleType::single;
         write_light_field(path, LightField(buffer), options);
         return 0.0;
     }},
    {"read a light field",
     [](const std::string& path, bool tell) {
         const LightField opened = open_light_field_or_views(path);
         LightFieldBuffer read(opened.grid());
         copy(opened.front(), read);
         return tell ? sum_of(read.radiance.data(), read.radiance.size()) : 0;
     }},
    {"compress",
     [](const std::string& path, bool tell) {
         CompressionOptions options;
         options.target = Step{0.05};
         const CompressionResult result = compress(LightField(buffer), path, options);
         return tell ? result.sqnr : 0;
     }},
};

}  // namespace

extern "C" {

/// Takes copies of a field [side][side] and of a light field [3][hogels][hogels][directions][directions] whose hologram
/// has the field's samples.
__attribute__((visibility("default"))) void twin_take(const float* samples, std::size_t side, double pitch,
                                                      const float* radiance, std::size_t hogels,
                                                      std::size_t directions) {
    field = std::make_shared<Field>(FieldGrid{{side, side, pitch, pitch}, 532e-9});
    std::copy_n(reinterpret_cast<const Complex*>(samples), side * side, field->samples.data());
    const double hogel_pitch = static_cast<double>(side) * pitch / static_cast<double>(hogels);
    const LightFieldGrid grid{hogels,     hogels,     hogel_pitch,
                              directions, directions, field_of_view(10 * std::numbers::pi / 180)};
    buffer = std::make_shared<LightFieldBuffer>(grid);
    std::copy_n(radiance, buffer->radiance.size(), buffer->radiance.data());
}

/// Does what is asked; not a number if that failed.
__attribute__((visibility("default"))) double twin_do(const char* name, const char* path, int tell) {
    try {
        return requests.at(name)(path, tell != 0);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return std::nan("");
    }
}
}

// SPDX-License-Identifier: Apache-2.0
// EXT_meshopt_compression: streams that libmeshoptimizer's encoder makes of known numbers are those numbers again, and
// what is not as the extension has it is refused.
#include <meshoptimizer.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "hogel/scene/mesh_files/import_fixture.h"

namespace hogel::scene::mesh_files {
namespace {

std::string packed_attributes(const void* elements, std::size_t count, std::size_t stride) {
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    meshopt_encodeVertexVersion(0);
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), elements,
                                            count, stride));
    return bytes;
}
template <class T>
std::string packed(const std::vector<T>& elements, std::size_t stride) {
    return packed_attributes(elements.data(), elements.size() * sizeof(T) / stride, stride);
}

constexpr std::array<unsigned, 6> corners{0, 1, 2, 0, 2, 3};
std::string packed_triangles() {
    std::string bytes(meshopt_encodeIndexBufferBound(corners.size(), 4), '\0');
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), corners.data(),
                                           corners.size()));
    return bytes;
}
std::string packed_indices() {
    std::string bytes(meshopt_encodeIndexSequenceBound(corners.size(), 4), '\0');
    bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                             corners.data(), corners.size()));
    return bytes;
}

const std::vector<float> positions{0, 0, 0, 3, 0, 0, 3, 2, 0.5f, 0, 2, 0.5f};
const Vec3 normal = normalize(Vec3{0, -0.5, 2});

/// A view as the document has it, and its stream.
struct View {
    std::size_t count, stride;
    std::string mode, filter, stream;
    std::string more = {};  ///< JSON, instead of what is said before
};

View position_view(bool exponential) {
    if (!exponential) return {4, 12, "ATTRIBUTES", "NONE", packed(positions, 12)};
    std::vector<std::uint32_t> filtered(12);
    meshopt_encodeFilterExp(filtered.data(), 4, 12, 16, positions.data());
    return {4, 12, "ATTRIBUTES", "EXPONENTIAL", packed(filtered, 12)};
}
View normal_view(std::size_t stride) {
    std::vector<float> of_each;
    for (int i = 0; i < 4; ++i)
        for (const double value : {normal.x, normal.y, normal.z, 0.0}) of_each.push_back(static_cast<float>(value));
    std::vector<std::int8_t> filtered(4 * stride);
    meshopt_encodeFilterOct(filtered.data(), 4, stride, stride == 4 ? 8 : 12, of_each.data());
    return {4, stride, "ATTRIBUTES", "OCTAHEDRAL", packed(filtered, stride)};
}
/// A quarter of a turn about z.
View rotation_view() {
    const float half = static_cast<float>(std::numbers::sqrt2 / 2);
    const std::vector<float> turn{0, 0, half, half};
    std::vector<std::int16_t> filtered(4);
    meshopt_encodeFilterQuat(filtered.data(), 1, 8, 16, turn.data());
    return {1, 8, "ATTRIBUTES", "QUATERNION", packed(filtered, 8)};
}

/// Two triangles with positions, normals of 8 or 16 bits, texture coordinates of 16 bits, and one rotated instance. The
/// second buffer is a placeholder, as gltfpack writes it.
std::string file(const std::vector<View>& views, int index_type = 5123, int normal_type = 5120) {
    std::string streams, list;
    std::size_t before = 0;
    for (const View& view : views) {
        const std::string extension =
            !view.more.empty()
                ? view.more
                : fmt::format(R"("buffer":0,"byteOffset":{},"byteLength":{},"byteStride":{},"count":{},"mode":"{}"{})",
                              streams.size(), view.stream.size(), view.stride, view.count, view.mode,
                              view.filter.empty() ? "" : fmt::format(R"(,"filter":"{}")", view.filter));
        const std::size_t size = view.count * view.stride;
        list += fmt::format(
            R"({}{{"buffer":1,"byteOffset":{},"byteLength":{}{},"extensions":{{"EXT_meshopt_compression":{{{}}}}}}})",
            list.empty() ? "" : ",", before, size,
            view.mode == "ATTRIBUTES" ? fmt::format(R"(,"byteStride":{})", view.stride) : "", extension);
        streams += view.stream;
        before += size;
        while (streams.size() % 4 != 0) streams += '\0';
    }
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["EXT_meshopt_compression","KHR_mesh_quantization"],
"extensionsRequired":["EXT_meshopt_compression","KHR_mesh_quantization"],"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"ROTATION":4}}}}}}}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[3,2,0.5]}},
{{"bufferView":1,"componentType":{},"normalized":true,"count":4,"type":"VEC3"}},
{{"bufferView":2,"componentType":5123,"normalized":true,"count":4,"type":"VEC2"}},
{{"bufferView":3,"componentType":{},"count":6,"type":"SCALAR"}},
{{"bufferView":4,"componentType":5122,"normalized":true,"count":1,"type":"VEC4"}}],
"bufferViews":[{}],"buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}},
{{"byteLength":{},"extensions":{{"EXT_meshopt_compression":{{"fallback":true}}}}}}]}})",
        normal_type, index_type, list, streams.size(), base64(streams), before);
}

std::vector<View> usual_views() {
    const std::vector<std::uint16_t> coordinates{0, 65535, 65535, 65535, 65535, 0, 0, 0};
    return {position_view(true),
            normal_view(4),
            {4, 4, "ATTRIBUTES", "", packed(coordinates, 4)},
            {6, 2, "TRIANGLES", "", packed_triangles()},
            rotation_view()};
}

void expect_the_quad(const Scene& scene) {
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.triangles.size(), 2u);
    ASSERT_EQ(mesh.texture_coordinates.size(), mesh.positions.size());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t vertex = mesh.triangles[i / 3][i % 3];
        const float* p = &positions[3 * corners[i]];
        // Turned by 90 degrees about z; 16 bits of a share of the largest number.
        EXPECT_LT(length(mesh.positions[vertex] - Vec3{-p[1], p[0], p[2]}), 3e-4) << i;
        EXPECT_LT(length(mesh.normals[vertex] - Vec3{-normal.y, normal.x, normal.z}), 0.015) << i;
        EXPECT_EQ(mesh.texture_coordinates[vertex].u, p[0] > 0 ? 1 : 0);
        EXPECT_EQ(mesh.texture_coordinates[vertex].v, p[1] > 0 ? 1 : 0);
    }
}

class Meshopt : public Import {
  protected:
    void expect_wrong(std::size_t number, const View& view, const std::string& words) {
        std::vector<View> views = usual_views();
        views[number] = view;
        expect_refusal("wrong.gltf", file(views), words);
    }
};

TEST_F(Meshopt, every_mode_and_filter_is_what_was_packed) {
    expect_the_quad(import_scene(write("a.gltf", file(usual_views()))));
    std::vector<View> others = usual_views();
    others[0] = position_view(false);
    others[1] = normal_view(8);
    others[3] = {6, 4, "INDICES", "NONE", packed_indices()};
    expect_the_quad(import_scene(write("b.gltf", file(others, 5125, 5122))));
}

TEST_F(Meshopt, what_the_document_says_of_a_stream_is_checked) {
    const auto with = [](View view, std::size_t count, std::size_t stride) {
        view.count = count;
        view.stride = stride;
        return view;
    };
    const View position = position_view(true), triangles{6, 2, "TRIANGLES", "", packed_triangles()};
    expect_wrong(0, with(position, 4, 10), "byteStride is 10; expected a multiple of 4 up to 256");
    expect_wrong(0, with(position, 4, 0), "byteStride is 0");
    expect_wrong(0, with(position, 0, 12), "count is 0");
    expect_wrong(3, with(triangles, 6, 3), "byteStride is 3; expected 2 or 4");
    expect_wrong(3, with(triangles, 5, 2), "count is 5; expected three for each triangle");
    expect_wrong(1, with(normal_view(4), 4, 12), "expected 4 or 8 with the filter OCTAHEDRAL");
    expect_wrong(4, with(rotation_view(), 1, 4), "expected 8 with the filter QUATERNION");
    expect_wrong(0, {4, 12, "POINTS", "", position.stream}, "mode is missing or unknown");
    expect_wrong(0, {4, 12, "ATTRIBUTES", "COLOR", position.stream}, "filter is unknown");
    expect_wrong(3, {6, 2, "TRIANGLES", "EXPONENTIAL", triangles.stream}, "filter is for attributes");
    const std::string rest = R"("byteStride":12,"count":4,"mode":"ATTRIBUTES")";
    expect_wrong(0, {4, 12, "ATTRIBUTES", "", position.stream, R"("buffer":2,"byteLength":9,)" + rest}, "buffer is 2");
    expect_wrong(0, {4, 12, "ATTRIBUTES", "", position.stream, R"("byteLength":9,)" + rest}, "buffer missing");
    expect_wrong(0, {4, 12, "ATTRIBUTES", "", position.stream, R"("buffer":0,"byteLength":90000,)" + rest},
                 "is bytes 0 to 90000 of a buffer");
    expect_wrong(0, {4, 12, "ATTRIBUTES", "", position.stream, R"("buffer":0,"byteOffset":-4,"byteLength":9,)" + rest},
                 "byteOffset is -4");
    expect_wrong(0, {4, 12, "ATTRIBUTES", "", position.stream, R"("buffer":1,"byteLength":9,)" + rest},
                 "of a buffer; expected a part of its 1 bytes");
    expect_wrong(0, {5, 12, "ATTRIBUTES", "", position.stream, R"("buffer":0,"byteLength":9,)" + rest},
                 "byteLength is not what is packed there; expected 4 elements of 12 bytes");
}

TEST_F(Meshopt, what_a_stream_cannot_hold_takes_no_memory) {
    expect_wrong(0, {300000000, 12, "ATTRIBUTES", "", position_view(true).stream}, "announces 300000000 elements in");
    expect_wrong(3, {900000000, 2, "TRIANGLES", "", packed_triangles()}, "announces 900000000 elements in");
    expect_wrong(3, {2000000, 2, "INDICES", "", packed_indices()}, "announces 2000000 elements in");
    // Many views of one stream, each of which could hold what is announced.
    const std::vector<float> zeros(std::size_t{4096} * 64);
    std::vector<View> views = usual_views();
    views.push_back({4096, 256, "ATTRIBUTES", "", packed(zeros, 256)});
    const std::string start = file(views);
    const std::size_t at = start.rfind(R"({"buffer":1,"byteOffset":)"), end = start.find("}}}", at) + 3;
    const std::string view = start.substr(at, end - at);
    std::string many = start;
    for (int i = 0; i < 200; ++i) many.insert(end, "," + view);
    expect_refusal("many.gltf", many, "and those before it announce");
}

// A fork for each: some lengths, and some bits.
TEST_F(Meshopt, damaged_streams_are_refused_or_harmless) {
    const auto harmless = [&](std::size_t number, const std::string& stream) {
        std::vector<View> views = usual_views();
        views[number].stream = stream;
        const fs::path path = write("damaged.gltf", file(views));
        try {
            import_scene(path);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    };
    const std::vector<View> views = usual_views();
    for (const std::size_t number : {0, 1, 3, 4}) {
        const std::string& whole = views[number].stream;
        std::vector<View> cut = views;
        cut[number].stream.pop_back();
        expect_refusal("cut.gltf", file(cut), fmt::format("bufferViews[{}].extensions", number));
        for (std::size_t k = 1; k < 6; ++k) harmless(number, whole.substr(0, whole.size() * k / 6));
        for (std::size_t i = 0; i < whole.size(); i += 5) {
            std::string flipped = whole;
            flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
            harmless(number, flipped);
        }
    }
    std::vector<View> header = views;
    header[0].stream[0] = '\x7f';
    expect_refusal("header.gltf", file(header), "bufferViews[0].extensions.EXT_meshopt_compression is damaged");
}

}  // namespace
}  // namespace hogel::scene::mesh_files

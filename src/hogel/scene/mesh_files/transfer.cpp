// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/transfer.h"

#include <algorithm>
#include <array>
#include <set>
#include <type_traits>

#include "hogel/error.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/files.h"
#include "hogel/scene/mesh_files/limits.h"

namespace hogel::scene::mesh_files {
namespace {

enum class Tag : std::uint32_t { end, error, file, note, texture, mesh };
constexpr std::size_t max_text = 1 << 16;

/// Header of a mesh or texture, copied as in memory: both sides are the same program.
struct Head {
    Tag tag = Tag::end;
    std::uint32_t texture = 0, opacity_texture = 0, emission_texture = 0;
    TextureSource::Kind kind = TextureSource::Kind::file;
    std::uint32_t is_unlit = 0, material = 0, width = 0, height = 0;
    Rgb base_color, emission;
    float reflectance = 0, metallic = 0, roughness = 0, alpha = 1;
    std::uint32_t clamp = 0;                ///< whether the base-colour texture does not repeat
    std::uint64_t text = 0;                 ///< bytes of the name or message
    std::array<std::uint64_t, 8> counts{};  ///< elements of the arrays, in the order of arrays_of()
};
static_assert(std::is_trivially_copyable_v<Head>);

template <class M, class F>
void for_arrays(M& imported, const F& f) {
    auto& mesh = imported.mesh;
    f(0, mesh.positions);
    f(1, mesh.normals);
    f(2, mesh.colors);
    f(3, mesh.radiance);
    f(4, mesh.texture_coordinates);
    f(5, mesh.triangles);
    f(6, mesh.alphas);
    f(7, imported.second_coordinates);
}

class Receiver {
  public:
    Receiver(core::ChildProcess& child, const std::filesystem::path& folder, const std::string& file)
        : child_(child), folder_(folder), file_(file) {}

    Head head() {
        Head head;
        child_.read(&head, sizeof head);
        take(sizeof(ImportedMesh));
        return head;
    }
    std::string text(const Head& head) {
        std::string text;
        if (head.text > max_text) too_large();
        array(head.text, text);
        return text;
    }
    /// Raises the limit for an opened file.
    void file(const Head& head) {
        const std::string name = text(head);
        const auto path = find_in_folder(folder_, name);
        if (!path || !counted_.insert(*path).second) return;
        remaining_ += max_scene_bytes(std::filesystem::file_size(*path)) - max_scene_bytes(0);
    }
    template <class Array>
    void array(std::uint64_t count, Array& array) {
        using Element = typename Array::value_type;
        static_assert(std::is_trivially_copyable_v<Element>);
        if (count > remaining_ / sizeof(Element)) too_large();
        take(count * sizeof(Element));
        array.resize(count);
        child_.read(array.data(), count * sizeof(Element));
    }

  private:
    void take(std::uint64_t bytes) {
        if (bytes > remaining_) too_large();
        remaining_ -= bytes;
    }
    [[noreturn]] void too_large() const {
        reject_file(file_, "makes more geometry than a file of its size should", "an undamaged mesh file");
    }

    core::ChildProcess& child_;
    const std::filesystem::path& folder_;
    const std::string& file_;
    std::set<std::filesystem::path> counted_;
    std::uint64_t remaining_ = max_scene_bytes(0) + (std::uint64_t{1} << 20);  // includes messages and heads
};

TextureSource receive_texture(Receiver& from, const Head& head) {
    TextureSource texture;
    texture.kind = head.kind;
    texture.width = head.width;
    texture.height = head.height;
    texture.name = from.text(head);
    from.array(head.counts[0], texture.bytes);
    return texture;
}

ImportedMesh receive_mesh(Receiver& from, const Head& head) {
    ImportedMesh imported;
    imported.texture = head.texture;
    imported.opacity_texture = head.opacity_texture;
    imported.emission_texture = head.emission_texture;
    imported.is_unlit = head.is_unlit != 0;
    imported.material = head.material;
    Material& material = imported.mesh.material;
    material.base_color = head.base_color;
    material.emission = head.emission;
    material.reflectance = head.reflectance;
    material.metallic = head.metallic;
    material.roughness = head.roughness;
    material.alpha = head.alpha;
    if (head.clamp != 0) material.base_color_sampling = {TextureSampling::Wrap::clamp, TextureSampling::Wrap::clamp};
    imported.mesh.name = from.text(head);
    for_arrays(imported, [&](std::size_t i, auto& array) { from.array(head.counts[i], array); });
    return imported;
}

void send_text(int pipe, Tag tag, const std::string& text) {
    Head head;
    head.tag = tag;
    head.text = std::min(text.size(), max_text);
    core::ChildProcess::write(pipe, &head, sizeof head);
    core::ChildProcess::write(pipe, text.data(), head.text);
}

}  // namespace

void Sender::send(const TextureSource& texture) const {
    Head head;
    head.tag = Tag::texture;
    head.kind = texture.kind;
    head.width = texture.width;
    head.height = texture.height;
    head.text = texture.name.size();
    head.counts[0] = texture.bytes.size();
    core::ChildProcess::write(pipe_, &head, sizeof head);
    core::ChildProcess::write(pipe_, texture.name.data(), texture.name.size());
    core::ChildProcess::write(pipe_, texture.bytes.data(), texture.bytes.size());
}

void Sender::send(const ImportedMesh& imported) const {
    const Mesh& mesh = imported.mesh;
    Head head;
    head.tag = Tag::mesh;
    head.texture = imported.texture;
    head.opacity_texture = imported.opacity_texture;
    head.emission_texture = imported.emission_texture;
    head.is_unlit = imported.is_unlit ? 1 : 0;
    head.material = imported.material;
    head.base_color = mesh.material.base_color;
    head.emission = mesh.material.emission;
    head.reflectance = mesh.material.reflectance;
    head.metallic = mesh.material.metallic;
    head.roughness = mesh.material.roughness;
    head.alpha = mesh.material.alpha;
    head.clamp = mesh.material.base_color_sampling.wrap_u == TextureSampling::Wrap::clamp ? 1 : 0;
    head.text = mesh.name.size();
    for_arrays(imported, [&](std::size_t i, const auto& array) { head.counts[i] = array.size(); });
    core::ChildProcess::write(pipe_, &head, sizeof head);
    core::ChildProcess::write(pipe_, mesh.name.data(), mesh.name.size());
    for_arrays(imported, [&](std::size_t, const auto& array) {
        core::ChildProcess::write(pipe_, array.data(), array.size() * sizeof array[0]);
    });
}

void Sender::send_file(const std::filesystem::path& path) const { send_text(pipe_, Tag::file, path.string()); }

void Sender::send_note(const std::string& note) const { send_text(pipe_, Tag::note, note); }

void Sender::send_error(const std::string& message) const { send_text(pipe_, Tag::error, message); }

void Sender::send_end() const {
    const Head head;
    core::ChildProcess::write(pipe_, &head, sizeof head);
}

Imported receive(core::ChildProcess& child, const std::filesystem::path& folder, const std::string& file) {
    Receiver from(child, folder, file);
    Imported imported;
    for (;;) {
        const Head head = from.head();
        switch (head.tag) {
            case Tag::end:
                return imported;
            case Tag::file:
                from.file(head);
                break;
            case Tag::note:
                imported.notes.push_back(one_line(from.text(head)));
                break;
            case Tag::texture:
                imported.textures.push_back(receive_texture(from, head));
                break;
            case Tag::mesh:
                imported.meshes.push_back(receive_mesh(from, head));
                break;
            case Tag::error:
                throw Error(ErrorCode::bad_input, from.text(head));
            default:
                reject_file(file, "makes the mesh reader send invalid data", "an undamaged mesh file");
        }
    }
}

}  // namespace hogel::scene::mesh_files

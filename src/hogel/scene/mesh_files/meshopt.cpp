// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/meshopt.h"

#include <meshoptimizer.h>

namespace hogel::scene::mesh_files {

bool unpack(const PackedView& view, std::vector<unsigned char>& to) {
    const auto* packed = reinterpret_cast<const unsigned char*>(view.packed.data());
    const std::size_t size = view.packed.size();
    switch (view.mode) {
        case PackedView::Mode::triangles:
            return meshopt_decodeIndexBuffer(to.data(), view.count, view.stride, packed, size) == 0;
        case PackedView::Mode::indices:
            return meshopt_decodeIndexSequence(to.data(), view.count, view.stride, packed, size) == 0;
        case PackedView::Mode::attributes:
            break;
    }
    if (meshopt_decodeVertexBuffer(to.data(), view.count, view.stride, packed, size) != 0) return false;
    switch (view.filter) {
        case PackedView::Filter::none:
            break;
        case PackedView::Filter::octahedral:
            meshopt_decodeFilterOct(to.data(), view.count, view.stride);
            break;
        case PackedView::Filter::quaternion:
            meshopt_decodeFilterQuat(to.data(), view.count, view.stride);
            break;
        case PackedView::Filter::exponential:
            meshopt_decodeFilterExp(to.data(), view.count, view.stride);
            break;
    }
    return true;
}

}  // namespace hogel::scene::mesh_files

#pragma once

#include <array>
#include <string_view>

#include "hogel/math/vec.h"

namespace hogel {

/// The sides of a hemicube around a hogel ([K] 4.1): each looks at a part of the directions in a perspective of its
/// own. The front looks along +ζ, right and left along +x and −x, top and bottom along +y and −y. Of the four sides
/// only the half with ζ > 0 is used.
enum class Face { front, left, right, top, bottom };

inline constexpr std::array all_faces{Face::front, Face::left, Face::right, Face::top, Face::bottom};

/// The word for a face, as in files.
constexpr std::string_view name(Face face) {
    constexpr std::array<std::string_view, 5> names{"front", "left", "right", "top", "bottom"};
    return names[static_cast<std::size_t>(face)];
}

/// (x, y, ζ), relative to a hogel, as the face sees it: to the right in its picture, up, and forward. A rotation; the
/// five pictures side by side, the front in the middle, continue each other without a jump.
constexpr Vec3 to_face(Face face, Vec3 p) {
    switch (face) {
        case Face::left:
            return {p.z, p.y, -p.x};
        case Face::right:
            return {-p.z, p.y, p.x};
        case Face::top:
            return {p.x, -p.z, p.y};
        case Face::bottom:
            return {p.x, p.z, -p.y};
        case Face::front:
            break;
    }
    return p;
}

/// The way back: what the face sees right, up and forward, as (x, y, ζ).
constexpr Vec3 from_face(Face face, Vec3 q) {
    switch (face) {
        case Face::left:
            return {-q.z, q.y, q.x};
        case Face::right:
            return {q.z, q.y, -q.x};
        case Face::top:
            return {q.x, q.z, -q.y};
        case Face::bottom:
            return {q.x, -q.z, q.y};
        case Face::front:
            break;
    }
    return q;
}

}  // namespace hogel

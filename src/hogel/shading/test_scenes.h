// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::shading {

// Returns a square of two triangles with sides of twice `right` and `up`, facing their cross product.
inline Mesh square(Vec3 center, Vec3 right, Vec3 up, Rgb color = {1, 1, 1}) {
    Mesh mesh;
    mesh.positions = {center - right - up, center + right - up, center + right + up, center - right + up};
    mesh.normals.assign(4, normalize(cross(right, up)));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material.base_color = color;
    return mesh;
}

inline Light lamp(Vec3 position, float intensity) {
    Light light;
    light.kind = Light::Kind::point;
    light.position = position;
    light.intensity = {intensity, intensity, intensity};
    return light;
}

}  // namespace hogel::shading

#include "physics/solid/cord_directions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/solid/elements/dispatch.hpp"

namespace aquagraph::solid {

namespace {

using Vec3 = Eigen::Vector3d;

Vec3 vector(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}

Vec3 unit(const Vec3& v, ElementIndex element, const char* what) {
    const double length = v.norm();
    if (!(length > 1e-9)) throw std::invalid_argument("cords: element " + std::to_string(element) + " has no " + what);
    return v / length;
}

// The centre of an element and the parent direction along which it is thinnest.
void centre_and_normal(const Mesh<3>& mesh, ElementIndex element, Vec3& centre, Vec3& normal) {
    const Element& nodes = mesh.elements[std::size_t(element)];
    with_element_type<3>(nodes.size(), [&]<class Type>(Type) {
        const auto X = coordinates<Type>(mesh, nodes);
        const std::array<double, 3> middle =
            std::is_same_v<Type, Tet10> ? std::array<double, 3>{0.25, 0.25, 0.25} : std::array<double, 3>{};
        const auto s = Type::shape(middle);
        Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
        centre.setZero();
        for (std::size_t a = 0; a < Type::node_count; ++a) {
            centre += s.N[a] * vector(X[a]);
            J += vector(X[a]) * vector(s.dN[a]).transpose();
        }
        int thinnest = 0;
        for (int k = 1; k < 3; ++k)
            if (J.col(k).norm() < J.col(thinnest).norm()) thinnest = k;
        // The layer is spanned by the other two; their cross product is its normal, whatever the element's skew.
        normal = J.col((thinnest + 1) % 3).cross(J.col((thinnest + 2) % 3)).normalized();
    });
}

}  // namespace

std::array<double, 3> cord_direction(const Mesh<3>& mesh, ElementIndex element, const LayerFrame& layer, double angle) {
    Vec3 centre, normal;
    centre_and_normal(mesh, element, centre, normal);
    Vec3 reference = vector(layer.along), outward = vector(layer.normal);
    if (layer.around_axis) {
        const Vec3 axis = unit(vector(layer.axis), element, "axis");
        const Vec3 from_point = centre - vector(layer.point);
        outward = unit(from_point - from_point.dot(axis) * axis, element, "direction around the axis");
        reference = axis.cross(outward);
    }
    if (normal.dot(outward) < 0) normal = -normal;
    reference = unit(reference - reference.dot(normal) * normal, element, "reference direction in its layer");
    const Vec3 a = std::cos(angle) * reference + std::sin(angle) * normal.cross(reference);
    return {a[0], a[1], a[2]};
}

std::shared_ptr<const std::vector<CordDirection<Lane>>> cord_directions(const Mesh<3>& mesh,
                                                                        const std::vector<ElementIndex>& members,
                                                                        const Material& material) {
    const std::size_t packs = (members.size() + lanes - 1) / lanes, families = material.cords.size();
    auto directions = std::make_shared<std::vector<CordDirection<Lane>>>(packs * families);
    for (std::size_t p = 0; p < packs; ++p)
        for (std::size_t c = 0; c < families; ++c) {
            const CordFamily& family = material.cords[c];
            CordDirection<Lane>& cord = (*directions)[p * families + c];
            cord.stiffness = family.modulus * family.section / (family.spacing * family.thickness);
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto a = cord_direction(mesh, members[std::min(p * lanes + l, members.size() - 1)],
                                              material.layer, family.angle);
                for (std::size_t d = 0; d < 3; ++d) cord.a[d][l] = a[d];
            }
        }
    return directions;
}

}  // namespace aquagraph::solid

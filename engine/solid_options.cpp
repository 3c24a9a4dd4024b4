#include "engine/solid_options.hpp"

#include <algorithm>
#include <iterator>

#include "io/scene_time_law.hpp"

namespace aquagraph::engine {

namespace {

// Newton in water stops where its residual is this part of the forces: on the plate of 160 by 16 elements the
// deflection is then the one of 1e-8 to 1e-8 of it, while what the coupling itself leaves is some percent.
constexpr double residual_tolerance_in_water = 1e-6;

std::size_t index_of(const std::vector<io::RigidBodyScene>& bodies, const std::string& name) {
    const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const auto& body) { return body.name == name; });
    return std::size_t(found - bodies.begin());
}

template <int D>
void add_rigid_bodies(const io::SolidScene& from, solid::Options<D>& options) {
    for (const io::RigidBodyScene& body : from.rigid_bodies) {
        solid::RigidBody<D>& made = options.rigid_bodies.emplace_back();
        made.set = body.set;
        if (body.point) made.point = body.point->as<D>();
        made.mass = body.mass;
        std::copy_n(body.inertia.begin(), std::min(body.inertia.size(), made.inertia.size()), made.inertia.begin());
    }
    for (const io::RigidFreedomScene& motion : from.rigid_motions)
        options.rigid_bodies[index_of(from.rigid_bodies, motion.body)].motion[std::size_t(motion.freedom)] =
            io::time_function(motion.law);
    for (const io::RigidFreedomScene& load : from.rigid_loads) {  // several on one freedom add up
        TimeFunction& sum =
            options.rigid_bodies[index_of(from.rigid_bodies, load.body)].load[std::size_t(load.freedom)];
        TimeFunction more = io::time_function(load.law);
        sum.initial += more.initial;
        std::move(more.changes.begin(), more.changes.end(), std::back_inserter(sum.changes));
    }
}

template <int D>
void add_contacts(const io::SolidScene& from, solid::Options<D>& options) {
    for (const io::ContactScene& contact : from.contacts) {
        solid::Contact<D>& made = options.contacts.emplace_back();
        made.surface = contact.surface;
        made.ground.shape = contact.shape;
        made.ground.point = contact.point.as<D>();
        if (contact.direction) made.ground.direction = contact.direction->as<D>();
        made.ground.radius = contact.radius;
        made.ground.hollow = contact.hollow;
        made.friction = contact.friction;
        made.penalty = contact.penalty;
    }
    for (const io::GroundMotionScene& motion : from.ground_motions)
        for (std::size_t k = 0; k < from.contacts.size(); ++k)
            if (from.contacts[k].name == motion.contact)
                options.contacts[k].ground.displacement[std::size_t(motion.along)] = io::time_function(motion.law);
}

// All displacements of one set are one motion.
template <int D>
void add_motions(const io::SolidScene& from, solid::Options<D>& options) {
    for (const io::NodeMotionScene& motion : from.motions) {
        auto made = std::find_if(options.motions.begin(), options.motions.end(),
                                 [&](const auto& other) { return other.set == motion.set; });
        if (made == options.motions.end()) made = options.motions.insert(made, {motion.set, {}});
        made->displacement[std::size_t(motion.along)] = io::time_function(motion.law);
    }
}

template <int D>
void add_cords(const io::SolidScene& from, solid::Options<D>& options) {
    for (const io::CordsScene& cords : from.cords) {
        solid::Material* material = &options.material;
        for (solid::Part& part : options.parts)
            if (part.set == cords.set && !cords.set.empty()) material = &part.material;
        for (const double angle : cords.angles)
            material->cords.push_back({cords.modulus, cords.section, cords.spacing, cords.thickness, angle});
        solid::LayerFrame& layer = material->layer;
        layer.around_axis = cords.axis.has_value();
        if (cords.axis) layer.axis = cords.axis->as<3>();
        if (cords.axis_point) layer.point = cords.axis_point->as<3>();
        if (cords.along) layer.along = cords.along->as<3>();
        if (cords.normal) layer.normal = cords.normal->as<3>();
    }
}

}  // namespace

template <int D>
solid::Options<D> solid_options(const io::Scene& scene) {
    const io::SolidScene& from = *scene.solid;
    solid::Options<D> options;
    options.material = from.material;
    for (const io::PartScene& part : from.parts) options.parts.push_back({part.set, part.material});
    options.plane = from.plane;
    options.integration = from.integration;
    options.gravity = scene.gravity.as<D>();
    options.scheme = from.scheme;
    options.alpha = from.alpha;
    options.mass_damping = from.mass_damping;
    options.stiffness_damping = from.stiffness_damping;
    if (scene.fluid) {
        options.residual_tolerance = residual_tolerance_in_water;
        options.first_accelerations = solid::FirstAccelerations::resolved;  // the water's load is there at once
    }
    for (const io::Clamp& clamp : from.clamps) {
        solid::Clamp<D>& made = options.clamps.emplace_back();
        made.set = clamp.set;
        std::copy_n(clamp.fixed.begin(), D, made.fixed.begin());
    }
    add_cords(from, options);
    add_motions(from, options);
    for (const io::PressureScene& pressure : from.pressures)
        options.pressures.push_back({pressure.surface, io::time_function(pressure.law)});
    add_rigid_bodies(from, options);
    add_contacts(from, options);
    return options;
}

template solid::Options<2> solid_options(const io::Scene&);
template solid::Options<3> solid_options(const io::Scene&);

}  // namespace aquagraph::engine

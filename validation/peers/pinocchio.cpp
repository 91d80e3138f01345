// Time per call of Pinocchio's algorithms on a vehicle with a free base.
// usage: pinocchio NAME TABLE   (the table is made by joint_table.py)
// Each quantity is a whole call from the configuration on; where there are two conventions, both
// are timed and the faster one is what counts.
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/centroidal.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <random>
#include <sstream>

namespace pin = pinocchio;
using Vector = Eigen::VectorXd;

constexpr int STATES = 64, CALLS = 20000, BATCHES = 15;
volatile double kept;

struct Sample { Vector q, v, a; };

pin::Model read(const std::string& path) {
    pin::Model model;
    std::ifstream table(path);
    for (std::string line; std::getline(table, line);) {
        std::istringstream in(line);
        std::string kind;
        int parent;
        std::array<double, 28> x;
        in >> kind >> parent;
        for (double& number : x) in >> number;
        using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
        const Eigen::Vector3d axis(x.data());
        const pin::SE3 placement(Eigen::Map<Rows>(x.data() + 3), Eigen::Vector3d(x.data() + 12));
        const pin::Inertia inertia(x[15], Eigen::Vector3d(x.data() + 16), Eigen::Map<Rows>(x.data() + 19));
        const auto name = "joint_" + std::to_string(model.njoints);
        auto add = [&](auto joint) { return model.addJoint(parent, joint, placement, name); };
        const auto joint = kind == "free" ? add(pin::JointModelFreeFlyer())
                         : kind == "rx"   ? add(pin::JointModelRX())
                         : kind == "ry"   ? add(pin::JointModelRY())
                         : kind == "rz"   ? add(pin::JointModelRZ())
                         : kind == "turn" ? add(pin::JointModelRevoluteUnaligned(axis))
                                          : add(pin::JointModelPrismaticUnaligned(axis));
        model.appendBodyToJoint(joint, inertia, pin::SE3::Identity());
    }
    model.gravity.setZero();
    return model;
}

int main(int, char** arguments) {
    const std::string vehicle = arguments[1];
    const pin::Model model = read(arguments[2]);
    pin::Data data(model);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> between(-1, 1);
    auto draw = [&] { Vector x(model.nv); for (double& e : x) e = between(random); return x; };
    std::vector<Sample> samples;
    for (int i = 0; i < STATES; i++)
        samples.push_back({pin::integrate(model, pin::neutral(model), draw()), draw(), draw()});

    auto time = [&](const char* quantity, auto call) {
        std::array<double, BATCHES> ns;
        for (double& each : ns) {
            const auto begin = std::chrono::steady_clock::now();
            for (int i = 0; i < CALLS; i++) kept = call(samples[i % STATES]);
            each = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() / CALLS;
        }
        std::sort(ns.begin(), ns.end());
        std::cout << "{\"peer\": \"Pinocchio 4.1\", \"vehicle\": \"" << vehicle << "\", \"quantity\": \"" << quantity
                  << "\", \"minimum_ns\": " << ns.front() << ", \"median_ns\": " << ns[BATCHES / 2] << "}" << std::endl;
    };

    time("inverse_dynamics", [&](const Sample& s) { return pin::rnea(model, data, s.q, s.v, s.a)[0]; });
    for (const auto convention : {pin::Convention::LOCAL, pin::Convention::WORLD}) {
        time("mass_matrix", [&](const Sample& s) { return pin::crba(model, data, s.q, convention)(0, 0); });
        time("forward_dynamics", [&](const Sample& s) { return pin::aba(model, data, s.q, s.v, s.a, convention)[0]; });
    }
    time("momentum_matrix", [&](const Sample& s) { return pin::ccrba(model, data, s.q, s.v)(0, 0); });
    const int n = model.nv - 6;
    pin::Data::Matrix6x J(6, model.nv), Jstar(6, n);
    time("generalized_jacobian", [&](const Sample& s) {
        pin::ccrba(model, data, s.q, s.v);
        pin::computeJointJacobians(model, data, s.q);
        J.setZero();
        pin::getJointJacobian(model, data, model.njoints - 1, pin::LOCAL_WORLD_ALIGNED, J);
        const Eigen::Matrix<double, 6, 6> of_base = data.Ag.leftCols<6>();
        Jstar.noalias() = J.rightCols(n) - J.leftCols<6>() * of_base.partialPivLu().solve(data.Ag.rightCols(n));
        return Jstar(0, 0);
    });
    time("inverse_dynamics_derivatives", [&](const Sample& s) {
        pin::computeRNEADerivatives(model, data, s.q, s.v, s.a);
        return data.dtau_dq(0, 0);
    });
    time("forward_dynamics_derivatives", [&](const Sample& s) {
        pin::computeABADerivatives(model, data, s.q, s.v, s.a);
        return data.ddq_dq(0, 0);
    });
}

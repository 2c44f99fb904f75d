// Groups of neighbouring nodes of a stiffness, and how their displacements follow from a few coarse ones: the coarse
// unknowns of a group are its motions as a rigid body, so that these cost nothing on a coarse level either. No more
// than a step from one level to the next: multigrid.hpp makes a hierarchy of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solver/sparse_rows.hpp"
#include "solver/stiffness.hpp"

namespace cleave {

// Unknowns of a level: those of a node follow each other.
struct Nodes {
  std::vector<std::int32_t> begin;  // (nodes + 1) first unknown
  Eigen::MatrixXd modes;  // (unknowns, 3 or 6) what costs no energy where nothing holds it
  std::int64_t count() const { return std::ssize(begin) - 1; }
};

// Of the equations of a body: particles and their rigid motions about the middle.
Nodes particles_of(const Equations& equations, const Body& body);

// (nodes) number of the group, so that every node has one; the number of groups is returned.
std::int32_t aggregate(const SparseMatrix& k, const Nodes& nodes, std::vector<std::int32_t>& group);

// Columns that are orthonormal and span the modes in every group, each zero outside its own.
SparseRows tentative_prolongation(const Nodes& nodes, const std::vector<std::int32_t>& group,
                                  std::int32_t groups, Nodes& coarse);

}  // namespace cleave

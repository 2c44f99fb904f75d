// The tangent stiffness of a body for degrees of freedom that are free to move: from the parts that its formulation
// gives, or through its gradient operator,  K_(a,j)(b,m) = sum_q (1/Omega_q) A^q_jkml zeta_qa,k zeta_qb,l  over all particles a, b of
// row q, the point's own particle with - sum_p zeta_qp among them.                  [FEM stiffness]
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "model/body.hpp"
#include "solver/sparse_matrix.hpp"

namespace cleave {

// Numbers of the equations: -1 for a degree of freedom that is prescribed, has no stiffness, or lies
// out of the plane.
struct Equations {
  Equations() = default;
  // g: NULL for a formulation without it.
  Equations(const Body& body, const GradientOperator* g);
  // Of a formulation with a constant stiffness, when so many bonds had broken. Pieces that breaking has cut off
  // from all that is prescribed have no equations either: they stay where they are.
  Equations(const Body& body, std::int64_t broken);
  std::vector<std::int32_t> of;  // (3,n)
  std::int64_t count = 0;

 private:
  void number(const Body& body);
};

struct Stiffness {
  SparseMatrix free;                        // (count, count), both triangles
  std::vector<Eigen::Triplet<double>> fix;  // row: equation; column: 3 i + direction, prescribed
  double asymmetry = 0;                     // largest |A_ijkl - A_klij| over the largest |A_ijkl|
};

// From the present positions and the committed history. False if a law has no tangent there.
bool assemble(const Body& body, const GradientOperator* g, const HistoryArrays& committed,
              const Equations& equations, Stiffness& k);
// Of a constant stiffness, when so many bonds had broken.
void assemble_after(const Body& body, std::int64_t broken, const Equations& equations,
                    Stiffness& k);

// That the stiffness is singular; equation: one that nothing resists, or kNoEquation.
Error singular(const Body& body, const Equations& equations, std::int64_t equation);

}  // namespace cleave

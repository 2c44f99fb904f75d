// The tangent stiffness of a formulation that has no gradient operator, part by part, for the static solver.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cleave {

struct Body;

// Takes a part of the tangent stiffness: the matrix between the degrees of freedom of a few particles, symmetric,
// (D count, D count), particle by particle.
class StiffnessSink {
 public:
  virtual ~StiffnessSink() = default;
  virtual void add(std::span<const std::int32_t> particles, const double* matrix) = 0;
};

// What one bond took with it when it broke: K_after = K_before + V W V^T.
struct StiffnessChange {
  struct Column {  // of V; particles may come more than once
    std::vector<std::int32_t> particles;
    std::vector<double> values;  // (D, count)
  };
  std::vector<Column> columns;
  std::vector<double> weight;  // W, (columns, columns), symmetric
};

class StiffnessSource {
 public:
  virtual ~StiffnessSource() = default;
  // At the present positions, in a fixed order.
  virtual void add_stiffness(const Body& body, StiffnessSink& sink) const = 0;
  // Whether the rest of the body holds a particle at all.
  virtual bool holds(const Body& body, std::int64_t particle) const = 0;

  // Whether the stiffness depends on nothing but on which bonds carry. Then bonds have numbers in the order in
  // which they broke, from 1, and these are known: how many there are, the stiffness when the first so many had
  // broken, and what one of them took with it; an end that lost all its bonds is from then on held by itself.
  virtual bool constant_stiffness() const = 0;
  virtual std::int64_t broken_bonds() const = 0;
  virtual void add_stiffness_after(const Body& body, std::int64_t broken,
                                   StiffnessSink& sink) const = 0;
  virtual bool held_after(const Body& body, std::int64_t broken, std::int64_t particle) const = 0;
  virtual void stiffness_change(const Body& body, std::int64_t event,
                                StiffnessChange& change) const = 0;
};

}  // namespace cleave

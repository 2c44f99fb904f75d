#include "solver/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "material/tangent.hpp"
#include "model/stiffness_source.hpp"

namespace cleave {

namespace {

constexpr std::int32_t kFree = 0;

// The particles of a row with all weights, the point's own included.
template <int D>
struct Row {
  std::vector<std::int32_t> particle;
  std::vector<Vec<D>> zeta;

  void take(const GradientOperator& g, std::int64_t q) {
    particle.clear();
    zeta.clear();
    Vec<D> own;
    for (std::int32_t b = g.row_begin[q]; b < g.row_begin[q + 1]; ++b) {
      particle.push_back(g.neighbour[b]);
      zeta.push_back(load_vector<D>(g.zeta, b));
      for (int k = 0; k < D; ++k) own[k] -= zeta.back()[k];
    }
    if (!g.of_particles()) return;
    particle.push_back(static_cast<std::int32_t>(q));
    zeta.push_back(own);
  }
};

// Where an entry belongs: among the unknowns, or to a prescribed displacement.
class Entries {
 public:
  Entries(const Equations& equations, Stiffness& k) : equations_(equations), k_(k) {
    k.fix.clear();
    k.free.resize(equations.count, equations.count);
    k.free.setZero();
  }
  std::int32_t equation(std::int32_t dof) const {
    return equations_.of[static_cast<std::size_t>(dof)];
  }
  // row: number of an equation
  void add(std::int32_t row, std::int32_t dof, double value) {
    const std::int32_t column = equation(dof);
    if (column >= 0) {
      if (free_.size() == kGathered) finish();
      free_.emplace_back(row, column, value);
    } else {
      k_.fix.emplace_back(row, dof, value);
    }
  }
  void finish() {
    SparseMatrix part(equations_.count, equations_.count);
    part.setFromTriplets(free_.begin(), free_.end());
    free_.clear();
    if (k_.free.nonZeros() > 0) part = k_.free + part;
    k_.free.swap(part);
  }

 private:
  // Entries at a time: there are six of them for one of the matrix, and more memory for each.
  static constexpr std::size_t kGathered = std::size_t{1} << 24;

  const Equations& equations_;
  Stiffness& k_;
  std::vector<Eigen::Triplet<double>> free_;
};

class Parts final : public StiffnessSink {
 public:
  Parts(Entries& entries, int dimension) : entries_(entries), dimension_(dimension) {}
  void add(std::span<const std::int32_t> particles, const double* matrix) override {
    const std::size_t d = static_cast<std::size_t>(dimension_), size = d * particles.size();
    const auto dof = [&](std::size_t c) {
      return static_cast<std::int32_t>(kVector * particles[c / d]) +
             static_cast<std::int32_t>(c % d);
    };
    for (std::size_t r = 0; r < size; ++r) {
      const std::int32_t row = entries_.equation(dof(r));
      if (row < 0) continue;
      for (std::size_t c = 0; c < size; ++c) entries_.add(row, dof(c), matrix[size * r + c]);
    }
  }

 private:
  Entries& entries_;
  int dimension_;
};

// Which particles hang together: every one is in the piece of its root.
class Pieces final : public StiffnessSink {
 public:
  explicit Pieces(std::int64_t particles) : above_(static_cast<std::size_t>(particles)) {
    std::iota(above_.begin(), above_.end(), 0);
  }
  void add(std::span<const std::int32_t> particles, const double*) override {
    const std::int32_t first = root(particles.front());
    for (const std::int32_t p : particles) above_[static_cast<std::size_t>(root(p))] = first;
  }
  std::int32_t root(std::int32_t i) {
    while (above(i) != i) i = above(i) = above(above(i));
    return i;
  }

 private:
  std::int32_t& above(std::int32_t i) { return above_[static_cast<std::size_t>(i)]; }
  std::vector<std::int32_t> above_;
};

template <int D>
void add_row(const Row<D>& row, const Tangent<D>& tangent, double volume, Entries& entries) {
  const std::size_t count = row.particle.size();
  for (std::size_t b = 0; b < count; ++b) {
    double column[D][D][D];  // sum_l A_jkml zeta_b,l / Omega
    for (int j = 0; j < D; ++j)
      for (int k = 0; k < D; ++k)
        for (int m = 0; m < D; ++m) {
          double sum = 0;
          for (int l = 0; l < D; ++l) sum += tangent(j, k, m, l) * row.zeta[b][l];
          column[j][k][m] = sum / volume;
        }
    for (std::size_t a = 0; a < count; ++a) {
      for (int j = 0; j < D; ++j) {
        const std::int32_t equation =
            entries.equation(static_cast<std::int32_t>(kVector * row.particle[a] + j));
        if (equation < 0) continue;
        for (int m = 0; m < D; ++m) {
          double value = 0;
          for (int k = 0; k < D; ++k) value += row.zeta[a][k] * column[j][k][m];
          entries.add(equation, static_cast<std::int32_t>(kVector * row.particle[b] + m), value);
        }
      }
    }
  }
}

template <int D>
bool assemble_in(const Body& body, const GradientOperator& g, const HistoryArrays& committed,
                 Entries& entries, double& relative_asymmetry) {
  Row<D> row;
  double largest = 0, asymmetry = 0;
  for (std::int64_t q = 0; q < body.points; ++q) {
    if (!(g.volume[q] > 0)) continue;
    Tangent<D> a;
    const Increment increment{0, D == 2 ? std::sqrt(g.volume[q]) : std::cbrt(g.volume[q])};
    if (!tangent_at<D>(body.material, committed, load_tensor<D>(body.point.h, q), increment, q, a))
      return false;
    for (int c = 0; c < D * D * D * D; ++c) {
      const int i = c / (D * D * D), j = c / (D * D) % D, l = c / D % D, m = c % D;
      largest = std::fmax(largest, std::fabs(a(i, j, l, m)));
      asymmetry = std::fmax(asymmetry, std::fabs(a(i, j, l, m) - a(l, m, i, j)));
    }
    row.take(g, q);
    add_row<D>(row, a, g.volume[q], entries);
  }
  relative_asymmetry = largest > 0 ? asymmetry / largest : 0.0;
  return true;
}

}  // namespace

Equations::Equations(const Body& body, const GradientOperator* g)
    : of(static_cast<std::size_t>(kVector * body.particles), -1) {
  const int d = body.dimension();
  for (std::int64_t i = 0; i < body.particles; ++i) {
    const bool carried = g == nullptr ? body.formulation->stiffness()->holds(body, i)
                                      : !g->of_particles() || g->volume[i] > 0;
    for (int k = 0; k < d && carried; ++k) of[static_cast<std::size_t>(kVector * i + k)] = kFree;
  }
  number(body);
}

Equations::Equations(const Body& body, std::int64_t broken)
    : of(static_cast<std::size_t>(kVector * body.particles), -1) {
  Pieces pieces(body.particles);
  std::vector<char> held(static_cast<std::size_t>(body.particles), broken == 0 ? 1 : 0);
  if (broken > 0 && !body.prescribed.empty()) {
    body.formulation->stiffness()->add_stiffness_after(body, broken, pieces);
    for (const auto& dof : body.prescribed)
      held[static_cast<std::size_t>(pieces.root(dof.particle))] = 1;
  }
  for (std::int64_t i = 0; i < body.particles; ++i) {
    if (held[static_cast<std::size_t>(pieces.root(static_cast<std::int32_t>(i)))] == 0 ||
        !body.formulation->stiffness()->held_after(body, broken, i))
      continue;
    for (int k = 0; k < body.dimension(); ++k)
      of[static_cast<std::size_t>(kVector * i + k)] = kFree;
  }
  number(body);
}

void Equations::number(const Body& body) {
  for (const auto& dof : body.prescribed)
    of[static_cast<std::size_t>(kVector * dof.particle + dof.direction)] = -1;
  for (auto& equation : of) {
    if (equation == kFree) equation = static_cast<std::int32_t>(count++);
  }
}

bool assemble(const Body& body, const GradientOperator* g, const HistoryArrays& committed,
              const Equations& equations, Stiffness& k) {
  Entries entries(equations, k);
  k.asymmetry = 0;
  bool known = true;
  if (g == nullptr) {
    Parts parts(entries, body.dimension());
    body.formulation->stiffness()->add_stiffness(body, parts);
  } else {
    known = body.dimension() == 2 ? assemble_in<2>(body, *g, committed, entries, k.asymmetry)
                                  : assemble_in<3>(body, *g, committed, entries, k.asymmetry);
  }
  if (known) entries.finish();
  return known;
}

void assemble_after(const Body& body, std::int64_t broken, const Equations& equations,
                    Stiffness& k) {
  Entries entries(equations, k);
  Parts parts(entries, body.dimension());
  body.formulation->stiffness()->add_stiffness_after(body, broken, parts);
  entries.finish();
}

Error singular(const Body& body, const Equations& equations, std::int64_t equation) {
  const auto place = std::find(equations.of.begin(), equations.of.end(), equation);
  std::string where;
  if (equation >= 0 && place != equations.of.end()) {
    const std::int64_t dof = place - equations.of.begin();
    where =
        text(" (", body.particle_label(dof / kVector), " in ", "xyz"[dof % kVector], ", for one)");
  }
  return Error(CLEAVE_NO_CONVERGENCE,
               text(body.label(), ": the stiffness is singular: the body, or a part of it", where,
                    ", can move without resistance; prescribe displacements that hold it"));
}

}  // namespace cleave

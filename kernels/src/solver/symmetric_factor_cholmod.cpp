// By CHOLMOD, in a build that asks for it: parts of CHOLMOD are under the GPL, and so is what is linked with it. Its simplicial
// factor serves, not the supernodal one: that calls a BLAS whose sums depend on the number of threads. Updates and
// downdates are those of Davis and Hager.                                               [ST follow]
#include <algorithm>
#include <cstdint>
#include <new>

#include "solver/symmetric_factor.hpp"
// With the types above.
#include <cholmod.h>

namespace cleave {

struct SymmetricFactor::Library {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  std::vector<std::int32_t> place;  // of an equation in the factor

  Library() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = false;
    common.print = 0;
  }
  ~Library() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  // A matrix or what there was no memory for.
  template <class T>
  T* made(T* pointer) const {
    if (pointer == nullptr) throw std::bad_alloc();
    return pointer;
  }
  const std::int32_t* order() const { return static_cast<const std::int32_t*>(factor->Perm); }
  std::int64_t size() const { return static_cast<std::int64_t>(factor->n); }
  bool change(bool add, std::span<const SparseColumn> c);
};

SymmetricFactor::SymmetricFactor() : library_(std::make_unique<Library>()) {}
SymmetricFactor::~SymmetricFactor() = default;

bool SymmetricFactor::factor(const SparseMatrix& k) {
  Library& l = *library_;
  cholmod_sparse a = {};
  a.nrow = a.ncol = static_cast<std::size_t>(k.rows());
  a.nzmax = static_cast<std::size_t>(k.nonZeros());
  a.p = const_cast<std::int32_t*>(k.outerIndexPtr());
  std::int32_t no_row = 0;  // an empty matrix has places of nothing too
  double no_value = 0;
  a.i = a.nzmax == 0 ? &no_row : const_cast<std::int32_t*>(k.innerIndexPtr());
  a.x = a.nzmax == 0 ? &no_value : const_cast<double*>(k.valuePtr());
  a.stype = -1;  // both triangles are there
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = true;
  if (l.factor == nullptr) {
    l.factor = l.made(cholmod_analyze(&a, &l.common));
    l.place.resize(a.nrow);
    for (std::size_t c = 0; c < a.nrow; ++c)
      l.place[static_cast<std::size_t>(l.order()[c])] = static_cast<std::int32_t>(c);
  }
  cholmod_factorize(&a, l.factor, &l.common);
  if (l.common.status < CHOLMOD_OK) throw std::bad_alloc();
  return l.factor->minor == l.factor->n;
}

SymmetricFactor::Pivots SymmetricFactor::pivots() const {
  const Library& l = *library_;
  const auto* begin = static_cast<const std::int32_t*>(l.factor->p);
  const auto* count = static_cast<const std::int32_t*>(l.factor->nz);
  const auto* value = static_cast<const double*>(l.factor->x);
  Pivots found{Vector(l.size()), {}, {}};
  for (std::int64_t c = 0; c < l.size(); ++c) {
    found.values[c] = value[begin[c]];
    found.equations.push_back(l.order()[c]);
    found.entries.push_back(count[c]);
  }
  return found;
}

Vector SymmetricFactor::solve(const Vector& b) const {
  Library& l = *library_;
  cholmod_dense right = {};
  right.nrow = right.d = right.nzmax = static_cast<std::size_t>(b.size());
  right.ncol = 1;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* found = l.made(cholmod_solve(CHOLMOD_A, l.factor, &right, &l.common));
  Vector x = Eigen::Map<const Vector>(static_cast<const double*>(found->x), b.size());
  cholmod_free_dense(&found, &l.common);
  return x;
}

void SymmetricFactor::solve(std::span<const SparseColumn> b, std::vector<Vector>& x) const {
  for (const SparseColumn& column : b) {
    Vector dense = Vector::Zero(library_->size());
    for (const auto& [equation, entry] : column) dense[equation] += entry;
    x.push_back(solve(dense));
  }
}

bool SymmetricFactor::can_follow() { return true; }
bool SymmetricFactor::add(std::span<const SparseColumn> c) { return library_->change(true, c); }
bool SymmetricFactor::subtract(std::span<const SparseColumn> c) {
  return library_->change(false, c);
}

// Columns in the order of the factor.
bool SymmetricFactor::Library::change(bool add, std::span<const SparseColumn> c) {
  if (c.empty()) return true;
  std::vector<std::int32_t> begin = {0}, row;
  std::vector<double> value;
  for (const SparseColumn& column : c) {
    std::vector<std::pair<std::int32_t, double>> entries;
    for (const auto& [equation, entry] : column)
      entries.emplace_back(place[static_cast<std::size_t>(equation)], entry);
    std::sort(entries.begin(), entries.end());
    for (const auto& [r, entry] : entries) {
      row.push_back(r);
      value.push_back(entry);
    }
    begin.push_back(static_cast<std::int32_t>(row.size()));
  }
  cholmod_sparse columns = {};
  columns.nrow = factor->n;
  columns.ncol = c.size();
  columns.nzmax = row.size();
  columns.p = begin.data();
  columns.i = row.data();
  columns.x = value.data();
  columns.itype = CHOLMOD_INT;
  columns.xtype = CHOLMOD_REAL;
  columns.dtype = CHOLMOD_DOUBLE;
  columns.sorted = columns.packed = true;
  return cholmod_updown(add, &columns, factor, &common) != 0 && common.status == CHOLMOD_OK;
}

}  // namespace cleave

#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/told_losses.h"

namespace bruma::io {

/// The statements of an OBJ file that no picture shows, by keyword.
class ObjStatements {
  public:
    /// Takes note of a line that is none of v, vn, vt, f, usemtl and mtllib. Groups and objects are passed over: all
    /// are drawn.
    void add(std::string_view line);

    /// At most one sentence on all of them, with names and counts; empty: nothing is lost. `has_normals`: smoothing
    /// groups, which say where normals are to be computed, lose nothing then.
    std::string remark(bool has_normals) const;

  private:
    ToldLosses seen_;
};

}  // namespace bruma::io

export const helpText = `Embeds a coarse layout into a triangle mesh: every layout edge becomes a path on the surface.

Usage
  layout-embedding embed LAYOUT TARGET [options]   embed LAYOUT into TARGET (OBJ or OFF)
  layout-embedding check DIR LAYOUT TARGET         check what embed wrote to DIR
  layout-embedding layout TARGET --landmarks FILE --output LAYOUT.obj [options]
                                                   make a layout by collapsing TARGET's edges
                                                   until only the landmarks are left

Options of all
  --landmarks FILE     one 0-based target vertex id per line, in the order of the layout's
                       vertices; embed's default is by proximity, check's what embed wrote
  --repair             mend coincident and unused vertices, degenerate and duplicate faces
  --json               print one JSON object, also for errors

Options of embed
  --output DIR         write refined.obj, refined_map.json and embedding.json there
  --algorithm NAME     exact (default), branch-and-bound, greedy, praun, kraevoy or
                       schreiner
  --gap X              stop at this gap, (cost - lower bound) / cost (default 0.01)
  --time-limit S       stop the search after S seconds
  --work-limit N       stop the search after N units of work (about node expansions);
                       reproducible
  --memory-limit MB    refuse what would need more memory
  --seed N             seed of the tie-breaking perturbation (default 1)
  --shape NAME         short (default): paths as straight as their neighbours allow; even: crossing
                       the target's edges at even distances
  --quiet              print nothing but errors

Options of layout
  --output LAYOUT.obj  the file to write; its vertices are the landmarks, in their order
  --quads              merge pairs of triangles into well-shaped quads
  --quiet              print nothing but errors

  --help, --version

Exit codes: 0 a valid embedding or layout was written, or the check accepts; 1 none found within
the limits; 2 bad input or usage; 3 proved infeasible; 4 the check refuses; 5 internal error or out
of memory; 130 interrupted, with the best result written.`;

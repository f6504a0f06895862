export const helpText = `Embeds a coarse layout into a triangle mesh: every layout edge becomes a path on the surface.

Usage
  layout-embedding embed LAYOUT TARGET [options]   embed LAYOUT into TARGET (OBJ, OFF, PLY, STL
                                                   or GLB); or the files that an .inp file names
  layout-embedding quads LAYOUT TARGET --output DIR [options]
                                                   embed, and write a quad mesh, quads.obj, too
  layout-embedding map LAYOUT TARGET_A TARGET_B --landmarks-a FILE --landmarks-b FILE --output DIR
                                                   embed in both and map them onto each other
  layout-embedding batch LAYOUT FOLDER --output DIR [options]
                                                   embed in every mesh of FOLDER that has a
                                                   landmark file of its name; quads, and maps from
                                                   one of them; run again, it goes on where it
                                                   stopped
  layout-embedding check DIR LAYOUT TARGET         check what embed wrote to DIR
  layout-embedding layout TARGET --landmarks FILE --output LAYOUT.obj [options]
                                                   make a layout by collapsing TARGET's edges
                                                   until only the landmarks are left
  layout-embedding convert INPUT OUTPUT [--view X,Y,Z]
                                                   write what embed wrote to the folder INPUT as
                                                   .obj, .ply, .vtp, .glb or .svg, or the mesh
                                                   INPUT as .obj, .off or .ply

Options of all
  --landmarks FILE     one 0-based target vertex id per line, in the order of the layout's
                       vertices (or .vts, .json, MeshLab's .pp, Slicer's .mrk.json); embed's
                       default is by proximity, check's what embed wrote
  --repair             mend coincident and unused vertices, degenerate and duplicate faces
  --json               print one JSON object, also for errors

Options of embed
  --output DIR         write refined.obj, refined_map.json and embedding.json there
  --format LIST        write further formats there: ply, vtp, glb, svg, lem (files of the paper's
                       reference implementation), separated by commas
  --view X,Y,Z         for svg: the direction towards the eye (default 0,0,1); three more numbers
                       say what is up
  --algorithm NAME     exact (default), branch-and-bound, greedy, praun, kraevoy or
                       schreiner
  --gap X              stop at this gap, (cost - lower bound) / cost (default 0.01)
  --time-limit S       stop the search after S seconds
  --work-limit N       stop the search after N units of work (about node expansions);
                       reproducible
  --memory-limit MB    refuse what would need more memory
  --seed N             seed of the tie-breaking perturbation (default 1)
  --shape NAME         short (default): paths as straight as their neighbours allow; even: crossing
                       the target's edges at even distances; fair: short, then traced anew where
                       that makes thin patches rounder
  --boundary-edges W   free (default) or follow: along the boundary of the target, where both
                       landmarks of a layout boundary edge lie on it
  --features X         how much less paths cost along sharp edges, 0 (default) to 0.95; they stay
                       on such edges in every shape
  --vertex-costs FILE  one number per target vertex and line, 0.001 to 1000: what a unit of length
                       costs there
  --edge-weights FILE  one number per layout edge and line, 0.001 to 1000: how much the length of its
                       path counts
  --exclude DIR        an earlier output that is not to be found again (may be given several times;
                       landmarks need not be given again): the next best embedding
  --previous DIR       an earlier output for the same layout, target and landmarks (which need not
                       be given again), for the two options that follow
  --avoid LIST         other routes for these edges, separated by commas; all others follow
  --keep LIST          these edges keep their routes, as homotopy classes
  --report             report on lengths, roundness and distortion of every path and patch:
                       report.json, and in the object of --json
  --attributes         refined.obj (and .ply, .glb, .vtp) also have the texture coordinates, vertex
                       colours, groups and materials of the target's file
  --quiet              print nothing but errors

Options of quads, beside those of embed
  --edge-length X      wanted length of the quads' edges (default: about 4000 quads)
  --segments LIST      EDGE=N,...: numbers of segments of layout edges, which rule whole loops
  --relaxation N       rounds of relaxation on the surface (default 30)

Options of map, beside those of embed on searches and shapes
  --landmarks-a FILE, --landmarks-b FILE
                       the landmarks on either target (default: by proximity)
  --output DIR         write map.json (images of all vertices, in both directions), overlay_a.obj and
                       overlay_b.obj (the common refinement on either target, with the texture
                       coordinates of TARGET_A), and both embeddings to a/ and b/
  --rounds N           rounds of optimisation at most (default 5)
  --seam-passes N      how often the paths of both targets are moved at most to lower the distortion
                       (default 8); 0 maps the paths of one embedding onto those of the other

Options of batch, beside those of embed on searches and shapes
  --output DIR         write summary.csv and summary.json there, and a folder per member
  --reference NAME     the member that all others are mapped from (default: the first one)
  --edge-length X      wanted length of the quads' edges on the reference; all members get the same
                       connectivity
  --rounds N, --seam-passes N
                       as for map

Options of layout
  --output LAYOUT.obj  the file to write; its vertices are the landmarks, in their order
  --quads              merge pairs of triangles into well-shaped quads
  --quiet              print nothing but errors

  --help, --version

Exit codes: 0 a valid embedding or layout was written, or the check accepts; 1 none found within
the limits; 2 bad input or usage; 3 proved infeasible; 4 the check refuses; 5 internal error or out
of memory; 130 interrupted, with the best result written.`;

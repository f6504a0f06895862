// Quad meshes whose base complex is the layout.
import type { CallOptions } from "./input.js";

/** How fine a quad mesh is. An aborted `signal` ends its relaxation; the mesh is as far as it is. */
export interface QuadOptions extends CallOptions {
    /** Wanted length of edges, in the target's units. Default: one that gives about 4000 quads. */
    edgeLength?: number;
    /** Pairs of a layout edge and its number of segments, which rule its whole loops of quads. */
    segments?: readonly (readonly [edge: number, segments: number])[];
    /**
     * The `segments` of another quad mesh of the same layout, to get the same connectivity; the options
     * above don't count then.
     */
    segmentsAs?: ArrayLike<number>;
    /** How often all vertices are moved to even the mesh out. Default: 30. */
    relaxation?: number;
}

/** A quad mesh on the target whose base complex is the layout. */
export interface QuadMesh {
    /** 3 coordinates per vertex. */
    positions: Float64Array;
    /** 4 vertex ids per quad, counter-clockwise. */
    quads: Uint32Array;
    /** The layout face of each quad. */
    faces: Uint32Array;
    /**
     * The base complex as chains of vertices: the layout's edges in their order, then edges inside
     * of faces where they were subdivided.
     */
    chains: Uint32Array[];
    /** Numbers of segments, for `segmentsAs`. */
    segments: Uint32Array;
    /** Two per layout edge: the dual loops of its halves, the same unless `subdivided`. */
    loops: Uint32Array;
    /** Whether the layout had a face without four sides, so that all were subdivided once. */
    subdivided: boolean;
    /** The edge length that counts where none is given. */
    defaultEdgeLength: number;
    /** How good its quads are. */
    statistics: {
        /** Scaled Jacobians: 1 for a rectangle, not positive where a quad is flipped. */
        leastJacobian: number;
        /** The mean over all quads. */
        meanJacobian: number;
        /** Quads whose scaled Jacobian is not positive. */
        flipped: number;
        /** Degrees. */
        leastAngle: number;
        /** Degrees. */
        largestAngle: number;
        /** Root mean square of the differences to 90 degrees. */
        angleDeviation: number;
        /** Lengths of edges, in the target's units. */
        leastEdge: number;
        /** The mean of all edges. */
        meanEdge: number;
        /** The longest edge. */
        largestEdge: number;
    };
    /** As an OBJ file: faces in groups, the base complex as lines. */
    obj: Uint8Array;
}

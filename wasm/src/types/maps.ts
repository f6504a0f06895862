// Maps between two targets of one layout.
import type { CallOptions } from "./input.js";

/** Points of a triangle mesh. */
export interface SurfacePoints {
    /** Per point: a face, -1 for no point. */
    faces: Int32Array;
    /** Per point: 3 barycentric coordinates, in the order of the face's corners. */
    barycentrics: Float64Array;
}

/** How long a map is optimised. An aborted `signal` ends that; the map is as far as it is. */
export interface SurfaceMapOptions extends CallOptions {
    /** Rounds of optimisation at most; 0 leaves the maps of the patches as they are. Default: 5. */
    rounds?: number;
    /**
     * How often the paths of both targets are moved at most, so that points on a path need not be
     * mapped to a path of the other embedding; it ends where that gains little. 0 keeps both
     * embeddings as they are. Default: 8.
     */
    seamPasses?: number;
}

/**
 * How far a map is from an isometry, both targets scaled to area 1; means are over the area of the
 * reference.
 */
export interface MapDistortion {
    /** Symmetric Dirichlet energy, |J|^2 + |J^-1|^2: 4 for an isometry, else more. */
    meanEnergy: number;
    /** Of a single triangle of the overlay. */
    largestEnergy: number;
    /** Ratio of the larger to the smaller singular value: 1 where angles are kept. */
    meanConformal: number;
    /** Ratio of areas, the larger one over the smaller: 1 where areas are kept. */
    meanArea: number;
}

/**
 * A one-to-one map between the reference and another target of the same layout, piecewise linear
 * on the overlay of both meshes.
 */
export interface SurfaceMap {
    /** Per vertex of the reference its image on the target. */
    fromReference: SurfacePoints;
    /** Per vertex of the target its image on the reference. */
    toReference: SurfacePoints;
    /** The common refinement of both meshes: each triangle lies in one face of either. */
    overlay: {
        /** 3 vertex ids per triangle, counter-clockwise. */
        corners: Uint32Array;
        /** The layout face of each triangle. */
        patches: Uint32Array;
        /** The face of the reference and of the target that each triangle lies in. */
        referenceFaces: Uint32Array;
        /** The face of the target that each triangle lies in. */
        targetFaces: Uint32Array;
        /** 9 numbers per triangle: the barycentric coordinates of its corners in that face. */
        referenceWeights: Float64Array;
        /** The same for `targetFaces`. */
        targetWeights: Float64Array;
        /** 3 coordinates per vertex: where it lies on the reference and on the target. */
        referencePositions: Float64Array;
        /** The same on the target. */
        targetPositions: Float64Array;
    };
    /** Of the map as it is. */
    distortion: MapDistortion;
    /** Before optimisation. */
    firstDistortion: MapDistortion;
}

/* What the host tells the kernel: read by the C compiler and by OpenCL's, so of floats and ints alone. z is up; the
 * floor is the plane z = 0. */
#ifndef SCENE_H
#define SCENE_H

/* Its x and y axes for shading run along elevation and azimuth. */
typedef struct {
    float x, y, z, radius;
    float alpha_x, alpha_y; /* roughness below the pixel */
    float alpha_right;      /* what both have more at the sphere's right end, by the square from its left end */
    int material;           /* where its words begin */
} Sphere;

/* A rectangle, u and v at right angles, that shines from the side of cross(u, v) and casts no shadow. No ray may meet
 * two. */
typedef struct {
    float x, y, z;    /* a corner, */
    float ux, uy, uz; /* and the edges from it */
    float vx, vy, vz;
    float r, g, b; /* radiance */
} Lamp;

typedef struct {
    float x, y, z;                   /* the eye, */
    float right_x, right_y, right_z; /* and what a pixel at the right, at the top and in the middle of the image */
    float up_x, up_y, up_z;          /*   adds to the direction */
    float ahead_x, ahead_y, ahead_z;
} Camera;

typedef struct {
    Camera camera;
    int width, height;
    int samples; /* of a pixel, in this pass */
    int pass;    /* each has random numbers of its own */
    int seed;
    int by_cosine;     /* directions are drawn by the cosine, not by the material's lobes */
    int bounces;       /* surfaces on a path, at most */
    int white_sky;     /* radiance 1 from everywhere */
    float least_alpha; /* what every surface is roughened by */
    float tile_alpha;  /* of every other tile of the floor */
    int floor_material;
    int spheres, lamps;
} Settings;

#endif

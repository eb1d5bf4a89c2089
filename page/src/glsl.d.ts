declare module "*.glsl";

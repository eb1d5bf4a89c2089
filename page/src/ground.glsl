// Ground with lines every metre, whose width in pixels is constant, that fades towards the horizon.
varying vec2 place_m;
uniform vec3 line_colour;
uniform vec2 centre_m;

float lines(vec2 at) {
  vec2 pixel = max(fwidth(at), vec2(1e-5));
  vec2 near = abs(fract(at - 0.5) - 0.5) / pixel;
  vec2 share = (1.0 - smoothstep(0.4, 1.4, near)) * (1.0 - smoothstep(0.1, 0.5, pixel));
  return max(share.x, share.y);
}

vec4 ground(vec4 colour) {
  vec2 cell = mod(floor(place_m), 2.0);
  colour.rgb *= 1.0 - 0.05 * abs(cell.x - cell.y);
  colour.rgb = mix(colour.rgb, line_colour, max(0.4 * lines(place_m), 0.85 * lines(place_m / 5.0)));
  colour.a *= 1.0 - smoothstep(10.0, 60.0, length(place_m - centre_m));
  return colour;
}

#version 330
uniform sampler2D panorama;
in vec2 place;
out vec3 colour;

void main() {
    colour = texture(panorama, place).rgb;
}

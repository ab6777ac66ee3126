import{j as o}from"./chunk-U7U2WTVZ.js";function r(){return o("h1",{children:"FormView"})}export{r as FormView};

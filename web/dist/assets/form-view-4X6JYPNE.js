import{h as o}from"./chunk-GYUW27G2.js";function r(){return o("h1",{children:"FormView"})}export{r as FormView};

import{j as i}from"./chunk-U7U2WTVZ.js";function r({ids:n}){return i("h1",{children:n})}export{r as CompareView};
